// All words of the lab in one table: English, Chinese. {name} in a text is filled in.

const labWords = {
  // the frame
  open: ['Open the live lab', '打开实时实验室'],
  openHint: ['The engine itself, mysim, in this page: move the time step past its limit and see what happens.', '引擎 mysim 就在本页运行：把时间步长移过极限，看看会发生什么。'],
  labTitle: ['Live lab', '实时实验室'],
  scene: ['scene', '场景'],
  ownScene: ['your own scene', '你的场景'],
  changed: ['changed', '已修改'],
  original: ['original values', '恢复原值'],
  language: ['Language', '语言'],
  close: ['Close', '关闭'],
  waiting: ['The engine is being unpacked …', '正在解包引擎……'],
  noModule: ['The live lab is not in this page: it was made without the packages that compile mysim to WebAssembly (clang, lld, wasi-libc, libc++; see ./crosscheck doctor).', '本页不含实时实验室：生成时没有把 mysim 编译成 WebAssembly 所需的软件包（clang、lld、wasi-libc、libc++；见 ./crosscheck doctor）。'],
  noWasm: ['This browser does not run WebAssembly, which the live lab needs. The stored motions and all numbers of the page are there without it.', '此浏览器不能运行 WebAssembly，实时实验室因此无法打开。本页保存的动画和所有数据不受影响。'],
  noWebgl: ['This browser does not draw with WebGL 2, which the live lab needs. All numbers of the page are there without it.', '此浏览器不支持 WebGL 2，实时实验室因此无法打开。本页所有数据不受影响。'],

  // running
  run: ['Run', '运行'],
  pause: ['Pause', '暂停'],
  step: ['One step', '走一步'],
  restart: ['Restart', '重新开始'],
  speed: ['speed', '速度'],
  timeOf: ['{t} of {end} s', '{t} / {end} 秒'],
  byHandTime: ['{t} s, changed by hand', '{t} 秒，已手动改变'],
  frames: ['{n} frames/s', '{n} 帧/秒'],
  computing: ['computing {ms} ms a frame', '每帧计算 {ms} 毫秒'],
  realTime: ['{x} × real time', '实时的 {x} 倍'],
  behind: ['The computing takes longer than the clock: time passes at {x} × its speed.', '计算跟不上时钟：时间以 {x} 倍的速度流逝。'],
  endReached: ['The end of the scene is reached.', '场景已到终点。'],

  // methods
  methods: ['Methods', '方法'],
  stepperOf: ['stepper of {letter}', '{letter} 的时间积分方法'],
  stepOf: ['time step of {letter}', '{letter} 的时间步长'],
  toleranceOf: ['tolerance of {letter}', '{letter} 的容差'],
  timeStep: ['time step', '时间步长'],
  tolerance: ['tolerance', '容差'],
  second: ['Compare with a second method', '与第二种方法比较'],
  removeSecond: ['Remove {letter}', '去掉 {letter}'],
  limitMark: ['predicted critical step {h}', '预测的临界步长 {h}'],
  limitNone: ['predicted: stable at no step', '预测：任何步长都不稳定'],
  limitAll: ['predicted: stable at every step', '预测：任何步长都稳定'],
  limitUnknown: ['no critical step is predicted here', '此处无法预测临界步长'],
  pastLimit: ['{x} × the predicted critical step', '预测临界步长的 {x} 倍'],
  sticky: ['sticky ball', '粘性球'],
  linear: ['one Newton step', '一次牛顿迭代'],
  refused: ['{method} does not take this scene: {reason}', '{method} 不能计算此场景：{reason}'],

  // the scene's numbers
  numbers: ['The scene', '场景参数'],
  stiffness: ['stiffness', '刚度'],
  structural: ['structural stiffness', '结构刚度'],
  shear: ['shear stiffness', '剪切刚度'],
  bend: ['bend stiffness', '弯曲刚度'],
  mass: ['mass of the cloth', '布的质量'],
  dashpot: ['dashpot', '阻尼器'],
  drag: ['drag', '阻力'],
  gravity: ['gravity', '重力'],
  wind: ['wind', '风'],
  airSpeed: ['wind speed', '风速'],
  gusts: ['gusts', '阵风'],
  ballRadius: ['ball radius', '球半径'],
  friction: ['friction', '摩擦系数'],
  restitution: ['restitution', '恢复系数'],
  frequency: ['frequency of the pins', '固定点频率'],
  rate: ['rate of turning', '转动速率'],
  leftOut: ['left out', '不计'],

  // the picture
  view: ['view', '视图'],
  over: ['overlaid', '重叠'],
  side: ['side by side', '并排'],
  colour: ['colour by', '着色'],
  byMethod: ['method', '方法'],
  byStretch: ['stretch', '伸长'],
  byError: ['distance to the truth', '与真值的距离'],
  springs: ['springs', '弹簧'],
  truth: ['truth', '真值'],
  resetView: ['reset view', '复位视角'],
  pictureLabel: ['{scene} in three dimensions. Arrow keys turn, plus and minus zoom, 0 resets the view; n and p choose a particle, i j k l u o move it, x pins or lets it go, Escape lets go of the hand.', '{scene} 的三维图。方向键旋转，加减键缩放，0 复位；n、p 选择质点，i j k l u o 移动它，x 固定或放开，Esc 松手。'],
  hint: ['Drag a particle to pull it, the background to turn. Click a particle to choose it; x pins it or lets it go. Keys on the picture: arrows turn, + − zoom, 0 resets, n p choose a particle, i j k l u o move it, Escape lets go; space runs, s steps, r restarts.', '拖动质点可拉动它，拖动背景可旋转。点击质点选中它，x 键固定或放开。图上的按键：方向键旋转，+ − 缩放，0 复位，n p 选质点，i j k l u o 移动它，Esc 松手；空格运行，s 走一步，r 重新开始。'],
  touchHint: ['Drag a particle to pull it, sideways on the background to turn; two fingers zoom.', '拖动质点可拉动它，在背景上横向拖动可旋转；双指缩放。'],
  particle: ['particle {i}', '质点 {i}'],
  pin: ['Pin', '固定'],
  unpin: ['Let go', '放开'],
  pinnedAt: ['particle {i}, pinned', '质点 {i}，已固定'],
  held: ['particle {i}, held by the hand', '质点 {i}，手持'],

  // truth and curves
  error: ['RMS error', '均方根误差'],
  errorBar: ['± {bar}', '± {bar}'],
  truthIs: ['Truth: {stepper} at {h}.', '真值：{stepper}，步长 {h}。'],
  truthByHand: ['Truth: {stepper} at {h}, from the state left by the hand.', '真值：{stepper}，步长 {h}，自手动改变后的状态起算。'],
  truthSame: ['Truth: the same stepper at a hundredth of the step.', '真值：同一方法，步长为百分之一。'],
  truthNone: ['No truth is computed for this scene.', '此场景没有可计算的真值。'],
  truthSlow: ['The truth would take {ms} ms a frame and is left out; a slower speed leaves time for it.', '真值每帧需 {ms} 毫秒，已略去；放慢速度即可计算。'],
  truthLate: ['The truth is catching up.', '真值正在追赶。'],
  noError: ['No truth is known here.', '此处没有真值。'],
  energy: ['energy', '能量'],
  energyTotal: ['total energy, from the start', '总能量（自起点）'],
  energyKinetic: ['kinetic energy', '动能'],
  energyElastic: ['elastic energy', '弹性势能'],
  energyGravitational: ['potential energy of gravity, from the start', '重力势能（自起点）'],
  noEnergy: ['A first-order scene has no energy.', '一阶场景没有能量。'],
  residual: ['relative energy residual', '相对能量残差'],
  ledger: ['energy balance', '能量平衡'],
  noResidual: ['The energy balance is not kept.', '未记录能量平衡。'],
  quantity: ['energy shown', '显示的能量'],

  // verdicts
  verdictEnergy: ['{letter} failed at {t} s: unphysical energy gain.', '{letter} 在 {t} 秒失败：能量非物理地增长。'],
  verdictNan: ['{letter} failed at {t} s: positions or velocities are no longer numbers.', '{letter} 在 {t} 秒失败：位置或速度已不是有限数。'],
  verdictStretch: ['{letter} failed at {t} s: a spring is more than ten times as long as in the true motion.', '{letter} 在 {t} 秒失败：有弹簧比真实运动中长十倍以上。'],
  verdictSolver: ['{letter} failed at {t} s: an equation inside a step had no solution.', '{letter} 在 {t} 秒失败：某一步内的方程无解。'],
  verdictFrozen: ['{letter} failed at {t} s: forces act, and nothing moves.', '{letter} 在 {t} 秒失败：有力作用却毫无运动。'],
  verdictOther: ['{letter} failed at {t} s: {reason}', '{letter} 在 {t} 秒失败：{reason}'],
  verdictPast: ['Its step is {x} × the predicted critical step.', '其步长是预测临界步长的 {x} 倍。'],
  verdictBelow: ['Its step is below the predicted critical step ({x} ×), which is that of the scene at its start.', '其步长低于预测的临界步长（{x} 倍）；该预测取自场景的初始状态。'],
  growth: ['Red arrows: the mode that grows.', '红色箭头：增长的模态。'],

  // doors
  copyLink: ['Copy link', '复制链接'],
  saveToml: ['Save TOML', '保存 TOML'],
  copyCommand: ['Copy command line', '复制命令行'],
  openToml: ['Open TOML …', '打开 TOML……'],
  linkCopied: ['The link is copied.', '链接已复制。'],
  commandCopied: ['The command line is copied: {command}', '命令行已复制：{command}'],
  savedToml: ['{file} is saved.', '已保存 {file}。'],
  notCopied: ['The browser does not allow copying; here it is: {text}', '浏览器不允许复制，内容如下：{text}'],
  drop: ['Drop the TOML file of a scene here.', '把场景的 TOML 文件拖放到此处。'],
  sceneRefused: ['The scene is not taken: {reason}', '场景未被接受：{reason}'],
  unknownScene: ['This page has no scene {name}.', '本页没有场景 {name}。'],
  broken: ['The engine stopped: {reason}', '引擎停止：{reason}'],
};

const labLanguages = ['en', 'zh'];
let labLanguage = [document.documentElement.lang, navigator.language].some(name => /^zh/i.test(name)) ? 'zh' : 'en';

/** The words of a key in the reader's language, with values filled in. */
const say = (key, values = {}) =>
    labWords[key][labLanguages.indexOf(labLanguage)].replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);

/** Changes the language; who shows words listens to 'lab-language' on the document. */
function setLabLanguage(language) {
  labLanguage = language;
  document.dispatchEvent(new Event('lab-language'));
}
