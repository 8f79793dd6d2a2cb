// All words of the lab and of its guided experiments: a key, English, Chinese. `{name}` is filled in by say().
// @ts-nocheck

export const labWords = {
  // The lab's frame.
  open: ['Open the live lab', '打开实时实验室'],
  openHint: [
    'The engine itself, mysim, in this page: move the time step past its limit and see what happens.',
    '引擎 mysim 就在本页运行：把时间步长移过极限，看看会发生什么。'
  ],
  labTitle: ['Live lab', '实时实验室'],
  scene: ['scene', '场景'],
  ownScene: ['your own scene', '你的场景'],
  changed: ['changed', '已修改'],
  original: ['original values', '恢复原值'],
  language: ['Language', '语言'],
  madeOf: ['the engine mysim, live in this page', '引擎 mysim，就在本页中运行'],
  close: ['Close', '关闭'],
  openInLab: ['Open in the lab', '在实验室中打开'],
  waiting: ['The engine is being unpacked …', '正在解包引擎……'],
  noModule: [
    'The live lab is not in this page: it was made without the packages that compile mysim to WebAssembly (clang, lld, wasi-libc, libc++; see crosscheck doctor).',
    '本页不含实时实验室：生成时没有把 mysim 编译成 WebAssembly 所需的软件包（clang、lld、wasi-libc、libc++；见 crosscheck doctor）。'
  ],
  noWasm: [
    'This browser does not run WebAssembly, which the live lab needs. The stored motions and all numbers of the page are there without it.',
    '此浏览器不能运行 WebAssembly，实时实验室因此无法打开。本页保存的动画和所有数据不受影响。'
  ],
  noWebgl: [
    'This browser does not draw with WebGL 2, which the live lab needs. All numbers of the page are there without it.',
    '此浏览器不支持 WebGL 2，实时实验室因此无法打开。本页所有数据不受影响。'
  ],

  // Running.
  run: ['Run', '运行'],
  pause: ['Pause', '暂停'],
  step: ['One step', '走一步'],
  restart: ['Restart', '重新开始'],
  time: ['time', '时间'],
  speed: ['speed', '速度'],
  timeOf: ['{t} of {end} s', '{t} / {end} 秒'],
  byHandTime: ['{t} s, changed by hand', '{t} 秒，已手动改变'],
  frames: ['{n} frames/s', '{n} 帧/秒'],
  computing: ['computing {ms} ms a frame', '每帧计算 {ms} 毫秒'],
  realTime: ['{x} × real time', '实时的 {x} 倍'],
  behind: [
    'The computing takes longer than the clock: time passes at {x} × its speed.',
    '计算跟不上时钟：时间以 {x} 倍的速度流逝。'
  ],
  endReached: ['The end of the scene is reached.', '场景已到终点。'],

  // Methods.
  methods: ['Methods', '方法'],
  stepperOf: ['stepper of {letter}', '{letter} 的时间积分方法'],
  stepOf: ['time step of {letter}', '{letter} 的时间步长'],
  toleranceOf: ['tolerance of {letter}', '{letter} 的容差'],
  timeStep: ['time step', '时间步长'],
  tolerance: ['tolerance', '容差'],
  second: ['Compare with a second method', '与第二种方法比较'],
  removeSecond: ['Remove {letter}', '去掉 {letter}'],
  limitMark: ['predicted critical step {h}', '预测的临界步长 {h}'],
  limitBeyond: [
    'predicted critical step {h}; the {interval} between two samples bound steps here',
    '预测的临界步长 {h}；此处步长不超过采样间隔 {interval}'
  ],
  limitNone: ['predicted: stable at no step', '预测：任何步长都不稳定'],
  limitAll: ['predicted: stable at every step', '预测：任何步长都稳定'],
  limitUnknown: ['no critical step is predicted here', '此处无法预测临界步长'],
  pastLimit: ['{x} × the predicted critical step', '预测临界步长的 {x} 倍'],
  taken: ['The run takes {h}: steps end where samples are.', '实际步长 {h}：步的终点与采样时刻对齐。'],
  'method.explicit-euler': ['explicit Euler', '显式欧拉'],
  'method.trapezoidal': ['trapezoidal', '显式梯形'],
  'method.rk4': ['rk4', '四阶龙格-库塔'],
  'method.symplectic-euler': ['symplectic Euler', '半隐式（辛）欧拉'],
  'method.leapfrog': ['leapfrog', '蛙跳'],
  'method.suzuki4': ['suzuki4', '四阶铃木（Suzuki）组合'],
  'method.dopri5': ['dopri5', '五阶 Dormand–Prince（自适应）'],
  'method.implicit-euler': ['implicit Euler', '隐式欧拉'],
  'method.implicit-midpoint': ['implicit midpoint', '隐式中点'],
  'option.events': ['events located', '步内定位接触'],
  'option.sticky': ['sticky', '粘性球'],
  'option.linear': ['linear', '一次牛顿迭代'],
  comma: [', ', '，'],
  sticky: ['sticky ball', '粘性球'],
  linear: ['one Newton step', '一次牛顿迭代'],
  refused: ['{method} does not take this scene: {reason}', '{method} 不能计算此场景：{reason}'],

  // The scene's numbers.
  numbers: ['The scene', '场景参数'],
  stiffness: ['stiffness', '刚度'],
  structural: ['structural stiffness', '结构刚度'],
  shear: ['shear stiffness', '剪切刚度'],
  bend: ['bend stiffness', '弯曲刚度'],
  bending: ['bending rigidity', '抗弯刚度'],
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

  // The picture.
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
  pictureLabel: [
    '{scene} in three dimensions. Arrow keys turn, plus and minus zoom, 0 resets the view; n and p choose a particle, i j k l u o move it, x pins or lets it go, Escape lets go of the hand.',
    '{scene} 的三维图。方向键旋转，加减键缩放，0 复位；n、p 选择质点，i j k l u o 移动它，x 固定或放开，Esc 松手。'
  ],
  hint: [
    'Drag a particle to pull it, the background to turn. Click a particle to choose it; x pins it or lets it go. Keys on the picture: arrows turn, + − zoom, 0 resets, n p choose a particle, i j k l u o move it, Escape lets go; space runs, s steps, r restarts.',
    '拖动质点可拉动它，拖动背景可旋转。点击质点选中它，x 键固定或放开。图上的按键：方向键旋转，+ − 缩放，0 复位，n p 选质点，i j k l u o 移动它，Esc 松手；空格运行，s 走一步，r 重新开始。'
  ],
  touchHint: [
    'Drag a particle to pull it, sideways on the background to turn; two fingers zoom.',
    '拖动质点可拉动它，在背景上横向拖动可旋转；双指缩放。'
  ],
  particle: ['particle {i}', '质点 {i}'],
  pin: ['Pin', '固定'],
  unpin: ['Let go', '放开'],
  pinnedAt: ['particle {i}, pinned', '质点 {i}，已固定'],
  held: ['particle {i}, held by the hand', '质点 {i}，手持'],

  // Truth and curves.
  error: ['RMS error', '均方根误差'],
  difference: ['RMS difference from a finer run', '与更细步长结果的均方根差'],
  errorBar: ['± {bar}', '± {bar}'],
  sameBits: [
    'The first 50 steps of {stepper} are those of the native engine, bit for bit.',
    '{stepper} 的前 50 步与本机引擎逐位相同。'
  ],
  otherBits: [
    'The first 50 steps of {stepper} are not those of the native engine: this browser computes otherwise.',
    '{stepper} 的前 50 步与本机引擎不同：此浏览器的计算方式不一样。'
  ],
  truthIs: ['Truth: {stepper} at {h}.', '真值：{stepper}，步长 {h}。'],
  truthByHand: [
    'Truth: {stepper} at {h}, from the state left by the hand.', '真值：{stepper}，步长 {h}，自手动改变后的状态起算。'
  ],
  truthSame: ['Truth: the same stepper at a hundredth of the step.', '真值：同一方法，步长为百分之一。'],
  truthNone: ['No truth is computed for this scene.', '此场景没有可计算的真值。'],
  truthSlow: [
    'The truth would take {ms} ms a frame and is left out; restarted at a slower speed there is time for it.',
    '真值每帧需 {ms} 毫秒，已略去；放慢速度并重新开始即可计算。'
  ],
  truthLarge: ['A scene this large has no truth beside it here.', '场景过大，此处不计算真值。'],
  truthLate: ['The truth is catching up.', '真值正在追赶。'],
  beforeRun: ['The curve begins with the run.', '运行后开始绘制曲线。'],
  noErrorHeld: ['The truth begins when the hand lets go.', '松手之后才计算真值。'],
  noError: ['No truth is known here.', '此处没有真值。'],
  energy: ['energy', '能量'],
  energyTotal: ['change of total energy', '总能量的变化'],
  energyKinetic: ['kinetic energy', '动能'],
  energyElastic: ['elastic energy', '弹性势能'],
  energyGravitational: ['change of potential energy', '重力势能的变化'],
  residual: ['relative energy residual', '相对能量残差'],
  ledger: ['energy balance', '能量平衡'],
  noResidual: ['The energy balance is not kept.', '未记录能量平衡。'],
  quantity: ['energy shown', '显示的能量'],

  // Verdicts.
  verdictEnergy: ['{letter} failed at {t} s: unphysical energy gain.', '{letter} 在 {t} 秒失败：能量非物理地增长。'],
  verdictNan: [
    '{letter} failed at {t} s: positions or velocities are no longer numbers.',
    '{letter} 在 {t} 秒失败：位置或速度已不是有限数。'
  ],
  verdictStretch: [
    '{letter} failed at {t} s: a spring is more than ten times as long as in the true motion.',
    '{letter} 在 {t} 秒失败：有弹簧比真实运动中长十倍以上。'
  ],
  verdictSolver: [
    '{letter} failed at {t} s: an equation inside a step had no solution.',
    '{letter} 在 {t} 秒失败：某一步内的方程无解。'
  ],
  verdictFrozen:
      ['{letter} failed at {t} s: forces act, and nothing moves.', '{letter} 在 {t} 秒失败：有力作用却毫无运动。'],
  verdictOther: ['{letter} failed at {t} s: {reason}', '{letter} 在 {t} 秒失败：{reason}'],
  verdictPast: ['Its step is {x} × the predicted critical step.', '其步长是预测临界步长的 {x} 倍。'],
  verdictBelow: [
    'Its step is below the predicted critical step ({x} ×), which is that of the scene at its start.',
    '其步长低于预测的临界步长（{x} 倍）；该预测取自场景的初始状态。'
  ],
  failed: ['failed', '失败'],
  growth: ['Red arrows: the mode that grows.', '红色箭头：增长的模态。'],

  // Doors.
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

  // The questions of the shipped scenes, as their files ask them.
  'question.bounce': ['How high does a particle rise again that a ball throws back?', '质点被球弹回后能升多高？'],
  'question.chain-link':
      ['To what does a position-based world converge as its step shrinks?', '步长缩小时，基于位置的方法收敛到什么？'],
  'question.chain':
      ['Do the engines agree on a chain of springs that is whipped about?', '对一条甩动的弹簧链，各引擎结果一致吗？'],
  'question.circle': [
    'How fast does each rule leave a circle that it should stay on?', '本应停留在圆上时，各种方法以多快的速度离开它？'
  ],
  'question.cloth-cantilever': [
    'How far does a strip of cloth droop under its own weight, held up by its bending rigidity alone?',
    '一条布只靠自身的抗弯刚度支撑，在自重下会下垂多少？'
  ],
  'question.cloth-carried': ['Does a ball that moves take the cloth on it along?', '移动的球会带着上面的布一起走吗？'],
  'question.cloth-hang': [
    'Do the engines agree on a cloth that falls, swings and comes to hang?',
    '布料下落、摆动、最后静止悬挂，各引擎结果一致吗？'
  ],
  'question.cloth-inextensible':
      ['Does a cloth whose threads cannot stretch swing as it should?', '线不可伸长的布料，摆动正确吗？'],
  'question.cloth-sphere': [
    'Does a cloth that falls on a ball slide, hold and rest as friction says?',
    '布料落到球上后，滑动、停住、静止都符合摩擦定律吗？'
  ],
  'question.cloth-stiff': [
    'Which methods bear the long step of an animation on a cloth a thousand times stiffer?',
    '布料硬一千倍时，哪些方法承受得住动画用的长步长？'
  ],
  'question.cloth-student': [
    'What do the two rules of the assignment do to a cloth as a student would set it up?',
    '按学生的设置，作业中的两种方法会让布料怎样？'
  ],
  'question.cloth-swing':
      ['Do the engines agree when the cloth is moved by hand?', '用手移动布料时，各引擎结果一致吗？'],
  'question.cloth-wind': ['Do the engines agree on a cloth in gusts of wind?', '布料处在阵风中，各引擎结果一致吗？'],
  'question.curtain': [
    'Do the engines agree on a curtain whose hem weighs ten times as much as each row above it?',
    '窗帘的下摆比上面每一行重十倍，各引擎结果一致吗？'
  ],
  'question.flag': ['Does a flag fly as the air presses on it?', '在气流的压力下，旗帜会飘扬吗？'],
  'question.jelly': ['Does a block of jelly land, wobble and come to rest?', '一块果冻落下后会晃动并最终静止吗？'],
  'question.normal-modes':
      ['Does a chain of springs keep the frequencies of its modes?', '弹簧链能保持各模态的频率吗？'],
  'question.pendulum': [
    'What does each rule do to a pendulum that swings slowly and vibrates fast?',
    '单摆摆动慢、振动快，各种方法会让它怎样？'
  ],
  'question.projectile':
      ['Does a thrown particle follow its parabola, slowed by the air?', '抛出的质点受空气阻力减速，轨迹正确吗？'],
  'question.rod': ['Which methods keep a length that must not change?', '哪些方法能保持不变的长度？'],
  'question.slide': ['Where does a particle that slides down a ball leave it?', '质点沿球面滑下，在哪里离开球面？'],
  'question.spring':
      ['Does one mass on a vertical spring keep its period and its energy?', '竖直弹簧上的质点能保持周期和能量吗？'],

  // The guide around the experiments.
  'guide.title': ['Guided experiments', '引导实验'],
  'guide.lead': [
    'First a guess, then a look, then the reason. Take them in any order, skip what you like.',
    '先猜，再看，最后讲原因。顺序随意，可以跳过。'
  ],
  'guide.step': ['Step {number} of {count}', '第 {number} 步，共 {count} 步'],
  'guide.done': ['done', '已完成'],
  'guide.guess': ['What do you guess?', '你猜会怎样？'],
  'guide.give': ['Guess', '提交'],
  'guide.without': ['Show me without a guess', '不猜，直接看'],
  'guide.try': ['Try it', '动手试'],
  'guide.do': ['Do it for me', '替我操作'],
  'guide.waiting': ['This step ticks itself when it has happened.', '出现该结果后，本步会自动打勾。'],
  'guide.why': ['Why', '为什么'],
  'guide.right': ['Your guess was right: {answer}.', '你猜对了：{answer}。'],
  'guide.wrong': ['You guessed: {guess}. What happened: {answer}.', '你猜的是：{guess}。实际结果：{answer}。'],
  'guide.answer': ['What happened: {answer}.', '实际结果：{answer}。'],
  'guide.near':
      ['You guessed {guess}, the lab reads {answer}: well predicted.', '你猜 {guess}，实验读数 {answer}：预测得很准。'],
  'guide.far': ['You guessed {guess}, the lab reads {answer}.', '你猜 {guess}，实验读数 {answer}。'],
  'guide.reads': ['The lab reads {answer}.', '实验读数：{answer}。'],
  'guide.back': ['Back', '上一步'],
  'guide.next': ['Next', '下一步'],
  'guide.skip': ['Skip', '跳过'],
  'guide.again': ['Repeat this step', '重做这一步'],
  'guide.onward': ['Next: {title}', '下一个：{title}'],
  'guide.all': ['All experiments', '全部实验'],
  'guide.leave': ['Close the guide', '关闭引导'],
  'guide.remember': ['Keep this', '记住这一点'],

  'sandbox.title': ['Sandbox', '自由实验'],
  'sandbox.about': ['No guide: ask your own question', '没有引导：自己提问题'],
  'sandbox.text':
      ['Everything may be changed now. Three questions to begin with:', '现在一切都可以改。先给你三个问题：'],
  'sandbox.a': [
    'How large a step does a cloth with twice the stiffness and half the mass bear?',
    '刚度加倍、质量减半的布料，步长最大能取多少？'
  ],
  'sandbox.b': [
    'Which stepper gives the smallest RMS error for the same number of force evaluations?',
    '力的计算次数相同时，哪种积分方法的均方根误差最小？'
  ],
  'sandbox.c': [
    'Drag a corner, let go, and watch the energy. Which steppers lose it?',
    '拖动一角再松手，观察能量。哪些方法会损失能量？'
  ],

  // 1
  'euler-circle.title': ['Euler\'s circle', '欧拉法与圆'],
  'euler-circle.about': ['Why a point leaves the circle that it should stay on', '点为什么会离开本应停留的圆'],
  'euler-circle.remember': [
    'The fastest motion in a scene decides the largest step: h ω must stay below the stepper’s own number. RK4’s is 2.83; explicit Euler’s is 0, as it always drifts outwards. Twice as fast, half the step.',
    '场景中最快的运动决定最大步长：h ω 必须小于该方法的一个固定数值（RK4：2.83；显式欧拉：0，任何步长都会向外漂）。运动快一倍，步长就要减半。'
  ],

  'euler-circle.tangent.question': [
    'A point goes round a circle of 1 m. Explicit Euler moves it straight ahead in each step, with its present velocity. Where is it after two turns?',
    '一个点沿半径 1 m 的圆运动。显式欧拉法每一步都按当前速度直线前进。转两圈后它在哪里？'
  ],
  'euler-circle.tangent.outside': ['outside the circle', '圆外'],
  'euler-circle.tangent.on': ['on the circle', '圆上'],
  'euler-circle.tangent.inside': ['inside the circle', '圆内'],
  'euler-circle.tangent.task': [
    'Press run and let explicit Euler go round twice with a step of 0.1 s.',
    '按运行，让显式欧拉法以 0.1 s 的步长转两圈。'
  ],
  'euler-circle.tangent.why': [
    'Each step follows the tangent, and a tangent lies outside its circle. By Pythagoras the radius grows in each step by the factor √(1 + h²).',
    '每一步都沿切线走，而切线在圆外。由勾股定理，每一步半径都乘以 √(1 + h²)。'
  ],
  'euler-circle.tangent.formula': [
    '{n} steps of {h}: √(1 + h²) to the power {n} = {predicted}; the lab reads {radius}.',
    '{n} 步，步长 {h}：√(1 + h²) 的 {n} 次方 = {predicted}；实验读数 {radius}。'
  ],

  'euler-circle.half.question': [
    'Now half the step, so twice as many steps. How far outside does the point end?',
    '现在步长减半，步数加倍。点最后离圆多远？'
  ],
  'euler-circle.half.same': ['as far as before', '和之前一样远'],
  'euler-circle.half.half': ['about half as far', '大约一半'],
  'euler-circle.half.none': ['not at all', '不再偏离'],
  'euler-circle.half.task':
      ['Run A with 0.05 s beside B with 0.1 s, to the end.', '让 A（0.05 s）和 B（0.1 s）一起运行到底。'],
  'euler-circle.half.why': [
    'Half the step makes a quarter of the error in each step, but takes twice as many steps. About half of the error is left: order 1.',
    '步长减半，每步误差变为四分之一，但步数加倍。总误差约剩一半：这就是一阶。'
  ],
  'euler-circle.half.formula': [
    '{fine} m outside with {hFine}, {coarse} m with {hCoarse}.',
    '步长 {hFine} 时偏出 {fine} m，步长 {hCoarse} 时偏出 {coarse} m。'
  ],

  'euler-circle.mean.question': [
    'The trapezoidal rule goes by the mean of two velocities: that at the start, and that where Euler would end. What does it do with the same step?',
    '梯形法取两个速度的平均：起点的速度，和欧拉法终点处的速度。同样的步长下它会怎样？'
  ],
  'euler-circle.mean.far': ['it ends as far outside', '偏得一样远'],
  'euler-circle.mean.hardly': ['it hardly leaves the circle', '几乎不离开圆'],
  'euler-circle.mean.never': ['it never leaves the circle', '完全不离开圆'],
  'euler-circle.mean.task': [
    'Run A, explicit Euler, and B, trapezoidal, on one picture to the end.',
    '让 A（显式欧拉）与 B（梯形法）在同一画面中运行到底。'
  ],
  'euler-circle.mean.why': [
    'Its radius grows as well, but only by the factor √(1 + h⁴/4), about 1 + h⁴/8, in each step. No picture shows that; the number does.',
    '它的半径也在增大，但每步只乘以 √(1 + h⁴/4)，约 1 + h⁴/8。图上看不出，数字看得出。'
  ],
  'euler-circle.mean.formula': [
    'After {n} steps of {h}: trapezoidal {radius} m (predicted {predicted} m), Euler {euler} m.',
    '{n} 步、步长 {h} 之后：梯形法 {radius} m（预测 {predicted} m），欧拉法 {euler} m。'
  ],

  'euler-circle.faster.question': [
    'The point now turns four times as fast: its turning speed ω is 4 rad/s and no longer 1. Which step gives Euler the same spiral over two turns as 0.1 s did before?',
    '现在点转得快四倍：转动速度 ω 从 1 rad/s 变为 4 rad/s。步长取多少，欧拉法两圈的螺旋才和之前 0.1 s 时一样？'
  ],
  'euler-circle.faster.same': ['the same, 0.1 s', '不变，0.1 s'],
  'euler-circle.faster.half': ['half, 0.05 s', '一半，0.05 s'],
  'euler-circle.faster.quarter': ['a quarter, 0.025 s', '四分之一，0.025 s'],
  'euler-circle.faster.task': [
    'Make the step smaller until a run of two turns ends with a radius below 1.9 m.',
    '减小步长，直到转两圈后半径小于 1.9 m。'
  ],
  'euler-circle.faster.why': [
    'The rule cannot see seconds. It sees only which part of a turn one step covers, and that is the product h ω.',
    '方法看不到秒数，它只看到一步走了一圈的多大部分，也就是乘积 h ω。'
  ],
  'euler-circle.faster.formula': [
    'h ω = {h} × {omega} rad/s = {product}; radius {radius} m.',
    'h ω = {h} × {omega} rad/s = {product}；半径 {radius} m。'
  ],

  'euler-circle.largest.question': [
    'RK4 goes by four velocities in each step and keeps to the circle very well. Is there a step at which it runs away, too?',
    'RK4 每步取四个速度，能很好地保持在圆上。是否存在某个步长，让它也跑飞？'
  ],
  'euler-circle.largest.never': ['no, it is never worse than inexact', '没有，最多只是不精确'],
  'euler-circle.largest.some': ['yes, past a certain step', '有，超过某个步长就会'],
  'euler-circle.largest.always': ['yes, at every step', '有，任何步长都会'],
  'euler-circle.largest.task': [
    'ω is still 4 rad/s. Make the step larger until RK4 leaves the circle outwards.',
    'ω 仍是 4 rad/s。增大步长，直到 RK4 向圆外跑。'
  ],
  'euler-circle.largest.why': [
    'Each step multiplies the radius by √(1 − a⁶/72 + a⁸/576), with a = h ω. Up to a = √8 = 2.83, RK4’s own number, that is at most 1; past it more, and more again in the next step.',
    '记 a = h ω，每步半径乘以 √(1 − a⁶/72 + a⁸/576)。a 不超过 √8 = 2.83（RK4 自己的数值）时该因子至多为 1；超过后大于 1，步步放大。'
  ],
  'euler-circle.largest.formula': [
    'Largest step: 2.83 / ω = 2.83 / {omega} = {limit}. With {h} each step multiplies the radius by {factor}.',
    '最大步长：2.83 / ω = 2.83 / {omega} = {limit}。步长 {h} 时每步半径乘以 {factor}。'
  ],

  // 2
  'pendulum-energy.title': ['The pendulum\'s energy', '单摆的能量'],
  'pendulum-energy.about':
      ['Three steppers, no friction: who gains, who loses, who keeps', '三种方法，没有摩擦：谁增、谁减、谁守恒'],
  'pendulum-energy.remember': [
    'A good stepper keeps energy because of its form, not because its step is small. The fastest vibration decides its largest step, even where nobody sees it.',
    '好的方法能保持能量，靠的是它的结构，而不是小步长。最快的振动决定最大步长，哪怕谁也看不见它。'
  ],

  'pendulum-energy.explicit.question': [
    'A mass swings on a stiff spring. There is no friction, so its energy should stay what it is. What does explicit Euler do with it?',
    '质点挂在一根硬弹簧上摆动。没有摩擦，能量应当不变。显式欧拉法会怎样？'
  ],
  'pendulum-energy.explicit.gains': ['the energy grows', '能量增加'],
  'pendulum-energy.explicit.keeps': ['the energy stays', '能量不变'],
  'pendulum-energy.explicit.loses': ['the energy falls', '能量减少'],
  'pendulum-energy.explicit.task':
      ['Run explicit Euler with a step of 5 ms, and watch the energy.', '以 5 ms 的步长运行显式欧拉法，观察能量。'],
  'pendulum-energy.explicit.why': [
    'A vibration is a circle, too: position one way, velocity the other. As before, each step makes it larger, by √(1 + (h ω)²).',
    '振动也是一个圆：一轴是位置，一轴是速度。和之前一样，每一步都把它放大 √(1 + (h ω)²) 倍。'
  ],
  'pendulum-energy.explicit.formula': [
    'ω = {omega} rad/s and h = {h}: {percent} % a step. At {t} there was {energy} J too much.',
    'ω = {omega} rad/s，h = {h}：每步增大 {percent} %。到 {t} 时多出 {energy} J。'
  ],

  'pendulum-energy.implicit.question': [
    'Implicit Euler takes the slope at the end of the step, which needs an equation to be solved. What does it do with the energy?',
    '隐式欧拉法取步末的斜率，为此要解方程。能量会怎样？'
  ],
  'pendulum-energy.implicit.gains': ['the energy grows', '能量增加'],
  'pendulum-energy.implicit.keeps': ['the energy stays', '能量不变'],
  'pendulum-energy.implicit.loses': ['the energy falls', '能量减少'],
  'pendulum-energy.implicit.task':
      ['Run implicit Euler with a step of 10 ms to the end.', '以 10 ms 的步长运行隐式欧拉法到底。'],
  'pendulum-energy.implicit.why': [
    'The end of the step looks back: the circle shrinks by 1 / √(1 + (h ω)²). It cannot burst, but it brakes a pendulum that nothing brakes.',
    '从步末往回看，圆每步缩小为 1 / √(1 + (h ω)²)。它不会爆，却让没有阻力的摆慢下来。'
  ],
  'pendulum-energy.implicit.formula': [
    'After {t} it has lost {energy} J of the {swing} J that the fall from the start to the lowest point gives.',
    '{t} 之后损失 {energy} J；从起点落到最低点共释放 {swing} J。'
  ],

  'pendulum-energy.leapfrog.question': [
    'Leapfrog takes half a step of position, a whole one of velocity, half a one of position. It costs as much as explicit Euler. And the energy?',
    '蛙跳法先走半步位置，再走一步速度，再走半步位置。计算量与显式欧拉相同。能量呢？'
  ],
  'pendulum-energy.leapfrog.grows': ['it grows, more slowly', '增加，但更慢'],
  'pendulum-energy.leapfrog.falls': ['it falls, more slowly', '减少，但更慢'],
  'pendulum-energy.leapfrog.swings': ['it is off a little and comes back', '略有偏差，但会回来'],
  'pendulum-energy.leapfrog.task': [
    'Run leapfrog with a step of 10 ms to the end, and watch the balance.',
    '以 10 ms 的步长运行蛙跳法到底，观察能量差额。'
  ],
  'pendulum-energy.leapfrog.why': [
    'Leapfrog turns and shears the circle but never changes an area in it. It follows, almost exactly, a motion whose energy is slightly different.',
    '蛙跳法会转动、剪切这个圆，但从不改变其中的面积。它几乎精确地遵循一个能量略有不同的运动。'
  ],
  'pendulum-energy.leapfrog.formula': [
    'Up to {t} the energy was off by {low} to {high} J, at the end by {end} J.',
    '到 {t} 为止，能量偏差在 {low} 到 {high} J 之间，结束时为 {end} J。'
  ],

  'pendulum-energy.which.question': [
    'The pendulum swings once in about 2.2 s. Its spring vibrates once in {period}, too little to be seen. Which decides the largest step of leapfrog?',
    '摆动一次约 2.2 s。弹簧振动一次 {period}，小得看不见。哪一个决定蛙跳法的最大步长？'
  ],
  'pendulum-energy.which.swing': ['the swing that one sees', '看得见的摆动'],
  'pendulum-energy.which.spring': ['the spring\'s fast vibration', '弹簧的快速振动'],
  'pendulum-energy.which.gravity': ['the strength of gravity', '重力的大小'],
  'pendulum-energy.which.task': [
    'The run stands just below the mark on the step’s slider. Move the step about a tenth past the mark and run.',
    '现在步长略低于滑块上的标记。把步长移到标记之上约十分之一，再运行。'
  ],
  'pendulum-energy.which.why': [
    'The spring must be followed even where nobody looks at it. Leapfrog can follow a vibration as long as h is below 2 / ω.',
    '就算没人看弹簧，也必须跟上它。只要 h 小于 2 / ω，蛙跳法就跟得上。'
  ],
  'pendulum-energy.which.formula': [
    'ω = √(k / m) = √({k} / {m}) = {omega} rad/s; 2 / ω = {limit}. With {h} it burst at {t}.',
    'ω = √(k / m) = √({k} / {m}) = {omega} rad/s；2 / ω = {limit}。步长 {h} 时在 {t} 爆开。'
  ],

  // 3
  'cloth-bursts.title': ['Where the cloth bursts', '布料何时爆开'],
  'cloth-bursts.about': ['Predict the largest step before you try it', '先预测最大步长，再验证'],
  'cloth-bursts.remember': [
    'The fastest vibration decides the largest step: h < 2 / ω, and ω grows with the root of stiffness over mass. Softer or heavier cloth bears a larger step.',
    '最快的振动决定最大步长：h < 2 / ω，而 ω 随“刚度 / 质量”的平方根增大。更软或更重的布料能用更大的步长。'
  ],

  'cloth-bursts.past.question': [
    'A cloth of {particles} particles hangs on two corners. The mark on the step’s slider says {limit}. What happens with a step 3 % past it?',
    '一块由 {particles} 个质点组成的布料挂在两角。步长滑块上的标记是 {limit}。步长超出 3 % 会怎样？'
  ],
  'cloth-bursts.past.inexact': ['it becomes a little less exact', '只是稍微不精确'],
  'cloth-bursts.past.slow': ['it shakes slightly for ever', '一直轻微抖动'],
  'cloth-bursts.past.bursts': ['it bursts within a fraction of a second', '不到一秒就爆开'],
  'cloth-bursts.past.task': [
    'Run it below the mark if you like. Then move the step just past the mark and run.',
    '可以先在标记之下运行。再把步长移到标记稍上方并运行。'
  ],
  'cloth-bursts.past.why': [
    'At h ω = 2 a step throws the fastest vibration exactly to its other side. Past that each throw is larger than the one before.',
    '当 h ω = 2 时，一步恰好把最快的振动甩到另一侧。再大一点，每次都比上一次甩得更远。'
  ],
  'cloth-bursts.past.formula': [
    'h ω = {product}: each step multiplies it by {factor}. It burst at {t}, after {n} steps: {factor} to the power {n} is 10 to the power {power}.',
    'h ω = {product}：每步放大 {factor} 倍。第 {n} 步（{t}）爆开：{factor} 的 {n} 次方约为 10 的 {power} 次方。'
  ],

  'cloth-bursts.mode.question': [
    'Something grows first, long before the cloth is torn apart. Which motion is it?',
    '在布料被撕碎之前，总有某种运动先增长。是哪一种？'
  ],
  'cloth-bursts.mode.swing': ['the whole cloth swings wider', '整块布越摆越宽'],
  'cloth-bursts.mode.folds': ['long waves run through the cloth', '长波在布中传播'],
  'cloth-bursts.mode.zigzag': ['particles a cell or two apart move against each other', '相隔一两格的质点反向运动'],
  'cloth-bursts.mode.task': [
    'Run once more, about 5 % past the mark, and look at the arrows: they show what grows.',
    '再运行一次，超出标记约 5 %，看箭头：它们显示正在增长的运动。'
  ],
  'cloth-bursts.mode.why': [
    'A short zigzag stretches the most springs for the least motion. So it is pulled back hardest, and vibrates fastest: it gives ω, and it is the first that a step cannot follow.',
    '短的锯齿用最小的位移拉长最多的弹簧。因此回复力最强、振动最快：它就是 ω，也最先跟不上步长。'
  ],
  'cloth-bursts.mode.formula': [
    'The picture shows that motion enlarged: of the pairs two cells apart {percent} % move against each other. One vibration takes 2π / ω = {period}, and a step may be at most its π-th part: {limit}.',
    '图中放大显示了这种运动：相隔两格的质点对中，{percent} % 反向运动。一次振动历时 2π / ω = {period}，步长最多是它的 π 分之一：{limit}。'
  ],

  'cloth-bursts.softer.question': [
    'All springs are now a quarter as stiff: {k} N/m instead of {kBefore} N/m. How large may the step become?',
    '所有弹簧的刚度变为四分之一：{kBefore} N/m 变成 {k} N/m。步长能取多大？'
  ],
  'cloth-bursts.softer.half': ['half as large', '一半'],
  'cloth-bursts.softer.same': ['as before', '不变'],
  'cloth-bursts.softer.twice': ['twice as large', '两倍'],
  'cloth-bursts.softer.four': ['four times as large', '四倍'],
  'cloth-bursts.softer.task': [
    'Run the soft cloth with a step that is at least 1.8 times the old mark of {limitBefore}. It must hold for half a second.',
    '让软布料以至少 1.8 倍旧标记（{limitBefore}）的步长运行。它要坚持半秒。'
  ],
  'cloth-bursts.softer.why': [
    'A softer spring pulls back less, so it vibrates more slowly. ω goes with √(k / m): a quarter of k is half of ω, and twice the step.',
    '弹簧更软，回复力更小，振动更慢。ω 与 √(k / m) 成正比：k 变为四分之一，ω 减半，步长加倍。'
  ],
  'cloth-bursts.softer.formula': [
    'ω fell from {omegaBefore} to {omega} rad/s; 2 / ω rose from {limitBefore} to {limit}. It held with {h}.',
    'ω 从 {omegaBefore} 降到 {omega} rad/s；2 / ω 从 {limitBefore} 升到 {limit}。步长 {h} 时没有爆开。'
  ],

  'cloth-bursts.heavier.question': [
    'The springs have {k} N/m again, where the mark was at {limitBefore}. The cloth now weighs {mass} kg instead of {massBefore} kg. Predict its largest step.',
    '弹簧恢复到 {k} N/m，那时标记在 {limitBefore}。布料质量由 {massBefore} kg 变为 {mass} kg。预测最大步长。'
  ],
  'cloth-bursts.heavier.task': [
    'Put your prediction to the test: find a step that bursts, and one within 10 % below it that holds for half a second.',
    '检验你的预测：找到一个会爆开的步长，再找一个比它小不到 10 % 而能坚持半秒的步长。'
  ],
  'cloth-bursts.heavier.why': [
    'Four times the mass is as good as a quarter of the stiffness: heavy particles answer the same pull more slowly. Only k / m counts.',
    '质量变为四倍，效果等于刚度变为四分之一：同样的拉力，重的质点反应更慢。只有 k / m 起作用。'
  ],
  'cloth-bursts.heavier.formula': [
    'It burst with {burst} and held with {held}; 2 / ω = 2 / {omega} = {limit}.',
    '步长 {burst} 爆开，{held} 没有爆开；2 / ω = 2 / {omega} = {limit}。'
  ],

  'cloth-bursts.finer.question': [
    'The same cloth of {massBefore} kg, now with 40 × 40 particles instead of 20 × 20, and the same springs. How large may the step be?',
    '同样 {massBefore} kg 的布料，由 20 × 20 个质点变成 40 × 40 个，弹簧刚度相同。步长能取多大？'
  ],
  'cloth-bursts.finer.twice': ['twice as large', '两倍'],
  'cloth-bursts.finer.same': ['as before', '不变'],
  'cloth-bursts.finer.half': ['half as large', '一半'],
  'cloth-bursts.finer.task': [
    'Run it with the step that was good before: 1 ms. Then find a step that holds for half a second.',
    '先用之前可行的步长 1 ms 运行。再找一个能坚持半秒的步长。'
  ],
  'cloth-bursts.finer.why': [
    'Each particle now has a quarter of the mass, at the same stiffness. So the zigzag vibrates twice as fast. That is why a fine cloth costs so much.',
    '每个质点的质量只有四分之一，刚度相同，因此锯齿振动快一倍。这就是精细布料昂贵的原因。'
  ],
  'cloth-bursts.finer.formula': [
    'ω = {omega} rad/s, 2 / ω = {limit}: {ratio} of what it was.',
    'ω = {omega} rad/s，2 / ω = {limit}：是原来的 {ratio}。'
  ],

  // 4
  'ball-friction.title': ['Sticky ball, sliding ball', '粘住的球与滑动的球'],
  'ball-friction.about': ['What Coulomb\'s cone allows', '库仑摩擦锥允许什么'],
  'ball-friction.remember': [
    'Friction can hold at most μ times the contact force. On a slope that is enough up to the angle whose tangent is μ.',
    '摩擦力最多是接触力的 μ 倍。在斜面上，它能撑到正切等于 μ 的那个角度。'
  ],

  'ball-friction.sticky.question': [
    'A particle starts on top of a ball with 1 m/s sideways. The assignment’s contact rule freezes whatever touches the ball. Where does the particle go?',
    '质点从球顶以 1 m/s 水平出发。作业里的接触规则会冻结一切碰到球的东西。质点会去哪里？'
  ],
  'ball-friction.sticky.off': ['it slides off', '滑下去'],
  'ball-friction.sticky.part': ['it slides a little and stops', '滑一点就停'],
  'ball-friction.sticky.stays': ['it never moves', '一动不动'],
  'ball-friction.sticky.task': [
    'Run A, the sticky ball, beside B with Coulomb friction of {mu}, to the end.',
    '让 A（粘住的球）与 B（库仑摩擦 {mu}）一起运行到底。'
  ],
  'ball-friction.sticky.why': [
    'The sticky rule takes all velocity at once, however small the contact force is. Real friction has a largest force, and takes only what that can.',
    '粘住规则不管接触力多小，一下子夺走全部速度。真实的摩擦力有上限，只能减掉它减得动的。'
  ],
  'ball-friction.sticky.formula': [
    'Sticky: moved by {moved} m. Coulomb: {away} m away from the start at {t}.',
    '粘住：移动了 {moved} m。库仑：{t} 时离起点 {away} m。'
  ],

  'ball-friction.leaves.question': [
    'With friction {mu} the particle slides down the ball. At which angle from the top does it fly off?',
    '摩擦系数 {mu} 时，质点沿球滑下。离球顶多少度时飞离？'
  ],
  'ball-friction.leaves.early': ['about 30°', '约 30°'],
  'ball-friction.leaves.middle': ['about 50°', '约 50°'],
  'ball-friction.leaves.late': ['about 90°, at the side', '约 90°，在侧面'],
  'ball-friction.leaves.task': ['Run until the particle has left the ball.', '运行到质点离开球为止。'],
  'ball-friction.leaves.why': [
    'The ball can only push. Contact ends where gravity no longer suffices to bend the path: v² / r = g cos θ.',
    '球只能推。当重力不足以让轨迹弯曲时接触就结束：v² / r = g cos θ。'
  ],
  'ball-friction.leaves.formula': [
    'The lab saw the last contact at {angle}°, with a speed of {v} m/s: v² / r = {need}, g cos θ = {have} m/s².',
    '实验中最后接触在 {angle}°，速度 {v} m/s：v² / r = {need}，g cos θ = {have} m/s²。'
  ],

  'ball-friction.cone.question': [
    'The particle now rests on the ball, {angle}° from the top. Which friction is just enough to hold it there? Predict μ.',
    '现在质点静止在离球顶 {angle}° 处。摩擦系数多大刚好能留住它？预测 μ。'
  ],
  'ball-friction.cone.task': [
    'Change the friction of the ball. Find one that holds to the end, and one at most 0.1 below it that does not.',
    '改变球的摩擦系数。找到一个能撑到底的，和一个比它小不超过 0.1 却撑不住的。'
  ],
  'ball-friction.cone.why': [
    'Gravity pulls m g sin θ along the ball and presses m g cos θ on it. Friction holds while m g sin θ ≤ μ m g cos θ: μ ≥ tan θ.',
    '重力沿球面的分量是 m g sin θ，压向球的是 m g cos θ。只要 m g sin θ ≤ μ m g cos θ，即 μ ≥ tan θ，就能留住。'
  ],
  'ball-friction.cone.formula': [
    'tan {angle}° = {tangent}. In the lab {held} held and {slid} did not. Mass and gravity do not count.',
    'tan {angle}° = {tangent}。实验中 {held} 留住了，{slid} 没有。与质量和重力无关。'
  ],

  'ball-friction.cloth.question': [
    'A cloth falls on the ball, off its centre. With friction {mu} it stays. What happens with {small}?',
    '一块布偏离中心落到球上。摩擦系数 {mu} 时它留住了。{small} 时会怎样？'
  ],
  'ball-friction.cloth.stays': ['it stays as well', '同样留住'],
  'ball-friction.cloth.slides': ['it slides off the ball', '从球上滑下'],
  'ball-friction.cloth.tears': ['it bursts', '爆开'],
  'ball-friction.cloth.task': ['Run it with friction {small} to the end.', '以摩擦系数 {small} 运行到底。'],
  'ball-friction.cloth.why': [
    'The middle of the cloth lies {angle}° from the top of the ball. Roughly, friction must be at least tan {angle}° = {tangent} to hold it.',
    '布料的中心落在离球顶 {angle}° 处。粗略地说，摩擦系数至少要有 tan {angle}° = {tangent} 才能留住它。'
  ],
  'ball-friction.cloth.formula': [
    '{mu} is more than {tangent}, {small} is less. In {t} the centre of mass went {sideways} m sideways and {down} m down.',
    '{mu} 大于 {tangent}，{small} 小于它。{t} 内质心横移 {sideways} m，下降 {down} m。'
  ],

  // 5
  'bend-springs.title': ['What bend springs do', '弯曲弹簧的作用'],
  'bend-springs.about': ['Take them out and see what the cloth does', '去掉它们，看布料怎样'],
  'bend-springs.remember': [
    'Bend springs keep a cloth from creasing sharply and hardly change where it hangs. Soft ones are enough, and cost no step.',
    '弯曲弹簧防止布料尖锐折叠，几乎不影响它挂在哪里。软的就够了，而且不影响步长。'
  ],

  'bend-springs.without.question': [
    'Bend springs join every particle with the next but one. We take them out of the hanging cloth. What changes?',
    '弯曲弹簧连接每个质点和隔一个的质点。把它们从悬挂的布料中去掉，会有什么变化？'
  ],
  'bend-springs.without.lower': ['the cloth hangs far lower', '布料垂得低得多'],
  'bend-springs.without.creases': ['it hangs alike, but creases sharply', '挂法相近，但出现尖锐折痕'],
  'bend-springs.without.nothing': ['nothing', '没有变化'],
  'bend-springs.without.task': ['Run the cloth without bend springs to the end.', '让没有弯曲弹簧的布料运行到底。'],
  'bend-springs.without.why': [
    'Structural and shear springs resist stretching, and a fold stretches nothing. Only a spring over two cells notices a fold.',
    '结构弹簧和剪切弹簧抵抗拉伸，而折叠并不拉伸什么。只有跨两格的弹簧才感觉到折叠。'
  ],
  'bend-springs.without.formula': [
    'Sharpest fold: {fold}° (0° is flat), where the edge between the corners tips over. Centre of mass {centre} m below the corners.',
    '最尖的折角：{fold}°（0° 为平），出现在两角之间翻倒的上边缘。质心在两角以下 {centre} m。'
  ],

  'bend-springs.with.question': [
    'And with bend springs of {bend} N/m, as stiff as the others: how sharp is the sharpest fold?',
    '加上 {bend} N/m 的弯曲弹簧（与其他弹簧一样硬）：最尖的折角有多大？'
  ],
  'bend-springs.with.same': ['about as sharp', '差不多一样尖'],
  'bend-springs.with.half': ['about half as sharp', '大约一半'],
  'bend-springs.with.flat': ['below 20°', '20° 以下'],
  'bend-springs.with.task': ['Run the cloth with bend springs to the end.', '让有弯曲弹簧的布料运行到底。'],
  'bend-springs.with.why': [
    'Where a fold is, the particles over two cells come closer. The bend spring pushes them apart until the bend is spread over many cells.',
    '折叠处，相隔两格的质点靠近。弯曲弹簧把它们推开，直到弯曲分散到许多格。'
  ],
  'bend-springs.with.formula': [
    'Sharpest fold: {fold}°. Centre of mass {centre} m below the corners.',
    '最尖的折角：{fold}°。质心在两角以下 {centre} m。'
  ],

  'bend-springs.price.question': [
    'Ten times stiffer bend springs, {bend} N/m. What happens to the largest step?',
    '弯曲弹簧再硬十倍，{bend} N/m。最大步长会怎样？'
  ],
  'bend-springs.price.same': ['it stays: the other springs decide', '不变：由其他弹簧决定'],
  'bend-springs.price.half': ['about half', '约一半'],
  'bend-springs.price.tenth': ['about a tenth', '约十分之一'],
  'bend-springs.price.task': [
    'Look where the mark is now. Run it with 1 ms, which was good before.', '看标记现在在哪里。用之前可行的 1 ms 运行。'
  ],
  'bend-springs.price.why': [
    'The zigzag that stretches bend springs most is now the fastest vibration. Ten times the stiffness of one family is at most √10 times ω.',
    '最拉伸弯曲弹簧的锯齿成为最快的振动。一类弹簧硬十倍，ω 最多变为 √10 倍。'
  ],
  'bend-springs.price.formula': [
    'ω rose from {omegaBefore} to {omega} rad/s; the mark fell from {limitBefore} to {limit}.',
    'ω 从 {omegaBefore} 升到 {omega} rad/s；标记从 {limitBefore} 降到 {limit}。'
  ],

  'bend-springs.enough.question': [
    'How little bend stiffness keeps every fold below 30°? A guess: which part of the other springs’ {k} N/m?',
    '弯曲刚度最小取多少，就能让所有折角小于 30°？猜猜是其他弹簧 {k} N/m 的多大部分？'
  ],
  'bend-springs.enough.half': ['about a half', '约一半'],
  'bend-springs.enough.fifth': ['about a fifth', '约五分之一'],
  'bend-springs.enough.tenth': ['a tenth or less', '十分之一或更少'],
  'bend-springs.enough.task': [
    'Choose a bend stiffness of at most {most} N/m with which no fold exceeds 30° to the end.',
    '选一个不超过 {most} N/m 的弯曲刚度，使得到最后没有折角超过 30°。'
  ],
  'bend-springs.enough.why': [
    'A fold costs a soft spring little force, but the cloth is light: little is enough. And the largest step is as large as without.',
    '软弹簧对折叠的抵抗很小，但布料很轻，这就够了。而且最大步长和没有时一样大。'
  ],
  'bend-springs.enough.formula': [
    'With {bend} N/m: sharpest fold {fold}°, largest step {limit} ({without} without bend springs).',
    '取 {bend} N/m：最尖折角 {fold}°，最大步长 {limit}（没有弯曲弹簧时 {without}）。'
  ],
};

const labLanguages = {
  en: 0,
  zh: 1
};
export let labLanguage =
    [document.documentElement.lang, navigator.language].some(name => /^zh/i.test(name)) ? 'zh' : 'en';

/**
 * The words of a key in the reader's language, with `{name}` replaced by values. A key that there is none of is shown.
 */
export function say(key, values = {}) {
  const words = labWords[key]?.[labLanguages[labLanguage]] ?? key;
  return words.replace(/\{(\w+)\}/g, (place, name) => (name in values ? String(values[name]) : place));
}

/** A scene's question in the reader's language, where it is that of a shipped scene; else as the scene asks it. */
export function questionInLanguage(question) {
  const key =
      Object.keys(labWords).find(each => each.startsWith('question.') && labWords[each][labLanguages.en] === question);
  return key ? say(key) : question;
}

/** Chooses a language; all that shows words hears 'lab-language' on the document. */
export function setLabLanguage(language) {
  if (language === labLanguage || !(language in labLanguages)) return;
  labLanguage = language;
  document.dispatchEvent(new Event('lab-language'));
}
