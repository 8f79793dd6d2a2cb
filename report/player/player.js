// <motion-player>: the motions of a scene's methods in lock-step. It stands behind the figure with the poster and the
// scene's data, and puts its canvas over the poster while it is in sight. Without WebGL2 the poster stays alone.

const mostStages = 3;  // drawn scenes alive at once: browsers allow few contexts
const alive = [];

const stillWanted = matchMedia('(prefers-reduced-motion: reduce)');
const dark = matchMedia('(prefers-color-scheme: dark)');

/** Whether this browser can play at all. */
function canPlay() {
  if (!('DecompressionStream' in window)) return false;
  const gl = document.createElement('canvas').getContext('webgl2');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return Boolean(gl);
}
const plays = canPlay();
document.documentElement.classList.toggle('plays', plays);

class MotionPlayer extends HTMLElement {
  connectedCallback() {
    if (!plays || this.scene) return;
    const root = this.parentElement;
    const scene = this.scene = this.given?.scene ?? JSON.parse(root.querySelector('script.motion').textContent);
    this.box = root.querySelector('.stage');
    Object.assign(this, {time: this.given ? 0 : scene.at ?? 0, untouched: true, speed: scene.speed ?? 1, playing: false, seen: false, orbit: new Orbit(scene.from)});
    const narrow = this.box.clientWidth < 700;
    const first = scene.methods.flatMap((m, i) => (m.first ? [i] : []));
    this.look = {
      colour: !scene.triangles ? 'plain' : scene.stretch ? 'stretch' : 'distance',
      springs: !scene.triangles,
      shown: narrow ? first.slice(0, 2) : first
    };
    if (!scene[this.look.colour]) this.look.colour = 'plain';
    this.controls = new Controls(this, scene, this.look, {
      toggle: () => (this.playing ? this.pause() : this.play()),
      seek: time => (this.pause(), this.seek(time), this.wake()),
      speed: speed => (this.speed = speed),
      look: change => (this.setLook(change), this.wake()),
      reset: () => (this.orbit.reset(), this.draw())
    });
    this.controls.setLook(this.look);
    this.controls.setPlaying(false);
    this.controls.setTime(this.time, this.frame);
    new IntersectionObserver(([entry]) => this.setSeen(entry.isIntersecting), {threshold: 0.4}).observe(this.box);
    new ResizeObserver(() => this.draw()).observe(this.box);
    dark.addEventListener('change', () => this.draw());
  }

  /** Comes into sight or leaves it: plays by itself once, where motion is welcome, and rests while out of sight. */
  async setSeen(seen) {
    this.seen = seen;
    if (!seen) {
      this.resume = this.wanted;
      this.pause();
      return;
    }
    // who wants no motion keeps the poster until a control is touched
    if (stillWanted.matches && !this.dataset.state) return;
    await this.wake();
    if (this.seen && !stillWanted.matches && (this.resume ?? true)) this.play();
  }

  /** Unpacks the data (once) and opens a stage; one that is out of sight gives way. */
  async wake() {
    this.data ??= unpackScene(this.scene, this.given?.motions);
    const data = await this.data;
    if (this.stage) return;
    while (alive.length >= mostStages) (alive.find(player => !player.seen) ?? alive[0]).sleep();
    const canvas = make('canvas', {'aria-hidden': 'true'});
    canvas.addEventListener('webglcontextlost', () => this.stage?.canvas === canvas && this.sleep());
    try {
      this.stage = new Stage(canvas, this.scene, data);
    } catch (problem) {
      this.hidden = true;  // the poster stays, without controls that control nothing
      throw problem;
    }
    this.titles = make('div', {class: 'titles', 'aria-hidden': 'true'});
    this.layer = make(
        'div', {
          class: 'layer',
          tabindex: 0,
          role: 'group',
          'aria-label':
              `${this.scene.scene} in three dimensions; arrow keys turn, plus and minus zoom, 0 resets the view`
        },
        canvas, this.titles);
    attachPointerInput(this.layer, this.orbit, () => this.draw());
    this.box.append(this.layer);
    alive.push(this);
    this.draw();
    this.dataset.state = 'ready';
  }

  /** Gives its context back; the poster is there again. */
  sleep() {
    this.pause();
    alive.splice(alive.indexOf(this), 1);
    const {gl} = this.stage.tools;
    this.stage = null;
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    this.layer.remove();
    this.dataset.state = 'asleep';
  }

  async play() {
    this.wanted = true;
    await this.wake();
    if (this.playing || !this.wanted) return;
    const {times} = this.scene, end = times[times.length - 1];
    if (this.untouched || this.time >= end) this.seek(0);  // at first it shows the poster's moment
    this.playing = true;
    this.controls.setPlaying(true);
    let last = null;
    const tick = now => {
      if (!this.playing) return;
      // a page that was held up goes on where it was
      const passed = Math.min(0.1, last === null ? 0 : (now - last) / 1000);
      last = now;
      this.seek(this.time + this.speed * passed);
      if (this.time >= end)
        this.pause();
      else
        requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = this.wanted = false;
    this.controls.setPlaying(false);
  }

  /** Shows a time, s. */
  seek(time) {
    const {times} = this.scene;
    this.untouched = false;
    this.time = Math.max(0, Math.min(times[times.length - 1], time));
    this.controls.setTime(this.time, this.frame);
    this.draw();
  }

  /** Frame at the present time, with its fraction. */
  get frame() {
    const {times} = this.scene, last = times.length - 1;
    return last * this.time / times[last];
  }

  setLook(change) {
    Object.assign(this.look, change);
    this.controls.setLook(this.look);
    this.draw();
  }

  draw() {
    if (!this.stage) return;
    const {canvas} = this.stage, ratio = Math.min(2, window.devicePixelRatio || 1);
    const wide = Math.round(this.box.clientWidth * ratio), high = Math.round(this.box.clientHeight * ratio);
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, {width: wide, height: high});
    const background = getComputedStyle(this.box).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(v => v / 255);
    const panels = this.stage.draw({...this.look, frame: this.frame, orbit: this.orbit, background});
    this.writeTitles(panels);
  }

  writeTitles(panels) {
    const {methods} = this.scene, {shown} = this.look;
    this.titles.replaceChildren(...panels.map((panel, k) => {
      const method = methods[shown[k]], over = method.failure && this.time >= method.stops;
      return make(
          'div', {style: `left:${100 * panel.left}%; top:${100 * panel.top}%; width:${100 * panel.wide}%`},
          make(
              'b', {style: `--own: ${method.colour}`},
              ...method.name.split(/(?<=\/)/).flatMap(part => [part, make('wbr')])),
          make(
              'span', {class: over ? 'failed' : ''},
              over                                ? method.failure :
                  this.time > method.stops + 1e-9 ? method.end :
                                                    ''));
    }));
  }
}
customElements.define('motion-player', MotionPlayer);
