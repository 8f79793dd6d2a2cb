// Draws the methods of one scene side by side, seen by one camera, into one canvas.

const titleHigh = 46;  // pixels of the page above each panel's picture

/** Panels in rows and columns so that the smaller side of each picture is as long as can be; `title` is above each. */
function gridOf(count, wide, high, title) {
  let best = {columns: 1, least: 0};
  for (let columns = 1; columns <= count; ++columns) {
    const least = Math.min(wide / columns, high / Math.ceil(count / columns) - title);
    if (least > best.least * 1.01) best = {columns, least};
  }
  return {columns: best.columns, rows: Math.ceil(count / best.columns)};
}

class Stage {
  constructor(canvas, scene, {triangles, springs, motions}) {
    Object.assign(this, {canvas, scene, triangles});
    const tools = this.tools = new Gl(canvas), gl = tools.gl, n = scene.particles;
    const panel = (method, i) => ({
      motion: new Motion(method, motions[i], n, triangles),
      points: tools.table(n),
      normals: triangles.length ? tools.table(n) : null,
      path: triangles.length ? null : tools.table(method.frames)
    });
    this.panels = scene.methods.map(panel);
    for (const {motion, path} of this.panels.filter(p => p.path)) {
      for (let f = 0; f < motion.method.frames; ++f) path.data.set([...motion.place(f, n - 1), -1], 4 * f);
      tools.fill(path);
    }
    const shade = fragmentCommon;
    this.programs = {
      cloth: tools.program(clothVertex, shade + clothFragment),
      thread: tools.program(clothVertex, threadFragment),
      ball: tools.program(ballVertex, shade + solidFragment),
      rod: tools.program(rodVertex, shade + solidFragment, '#define ROD\n'),
      floor: tools.program(floorVertex, shade + floorFragment),
    };
    this.casts = Object.fromEntries(Object.entries({cloth: clothVertex, ball: ballVertex, rod: rodVertex})
                                        .map(([name, text]) => [name, tools.program(text, 'void main() {}')]));
    this.shapes = shapesOf(tools, scene, triangles, springs);
    this.map = tools.shadowMap(1024);
    this.scale = tools.colours(scaleBytes());
    Object.assign(this, boundsOf(scene, this.panels.map(p => p.motion)));
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SCISSOR_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  /**
   * Draws the methods `shown` at a frame (with fraction). Returns the panels' places in the canvas, parts of its size.
   */
  draw({frame, shown, colour, springs, orbit, background}) {
    const {gl} = this.tools, {canvas, scene} = this;
    const ratio = canvas.width / canvas.clientWidth;
    const {columns, rows} = gridOf(shown.length, canvas.width, canvas.height, titleHigh * ratio),
                    cell = Math.floor(canvas.height / rows);
    const wide = Math.floor(canvas.width / columns), high = cell - Math.round(titleHigh * ratio), aspect = wide / high;
    const fit = orbit.fit(this.held, this.middle, aspect), view = orbit.view(fit, aspect);
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    return shown.map((which, i) => {
      const panel = this.panels[which], column = i % columns, row = Math.floor(i / columns);
      panel.motion.places(frame, colour, panel.points.data);
      this.tools.fill(panel.points);
      if (panel.normals) {
        panel.motion.normals(panel.points.data, panel.normals.data);
        this.tools.fill(panel.normals);
      }
      const pixel = 2 * tangent * fit.distance * orbit.zoom / high * ratio;
      const look = {
        ...view,
        frame,
        colour,
        springs,
        background,
        pixel,
        panel,
        surface: this.triangles.length && !springs,
        plain: rgb(panel.motion.method.colour)
      };
      if (scene.floor !== null) this.castShadows(look);
      const box = [column * wide, canvas.height - (row + 1) * cell, wide, high];
      gl.viewport(...box);
      gl.scissor(...box);
      this.drawPanel(look, box);
      return {left: column / columns, top: row / rows, wide: 1 / columns, high: 1 / rows};
    });
  }

  castShadows(look) {
    const {gl} = this.tools, {map} = this;
    const toKey = lightMatrix(this.key, this.middle, 1.03 * this.reach);
    look.toKey = toKey;
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.viewport(0, 0, map.size, map.size);
    gl.scissor(0, 0, map.size, map.size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 4);
    this.drawBodies(this.casts, look, {to_clip: toKey, eye: plus(this.middle, 100 * this.reach, this.key)});
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  drawPanel(look, box) {
    const {gl} = this.tools, {scene} = this, flat = scene.floor === null;
    const light = {
      to_clip: look.toClip,
      eye: look.eye,
      key: this.key,
      to_key: look.toKey || look.toClip,
      key_map: this.map.texture,
      lift: 0.006 * this.reach,
      shadowed: flat ? 0 : 1,
      scale_map: this.scale,
      by_value: look.colour === 'plain' ? 0 : 1,
      background: look.background,
      by_family: look.surface ? 0 : 1,
      families: palette.flatMap(rgb)
    };
    this.drawBodies(this.programs, look, light);
    if (flat) return;
    gl.depthMask(false);
    const foot = footOf(this.middle, scene.floor, this.key);
    this.tools.use(
        this.programs.floor, {...light, floor_at: [foot[0], scene.floor, foot[2], 2.2 * this.reach], panel: box});
    this.tools.draw(this.shapes.floor, gl.TRIANGLES);
    gl.depthMask(true);
  }

  /** Cloth or springs, beads, pins, path and obstacles, with the programs given. */
  drawBodies(programs, look, light) {
    const {gl} = this.tools, {tools, scene, shapes} = this, {panel, pixel} = look;
    const lit = programs === this.programs;
    const all = {
      ...light,
      points: panel.points.texture,
      normals: panel.normals && panel.normals.texture,
      plain: look.plain,
      nearer: 0,
      ball: [0, 0, 0, 0]
    };
    const thin = 0.9 * pixel, bead = Math.min(8 * pixel, 0.03 * this.size);
    if (look.surface) {
      tools.use(programs.cloth, all);
      tools.draw(shapes.cloth, gl.TRIANGLES);
      if (lit) {
        gl.enable(gl.BLEND);
        tools.use(programs.thread, {...all, nearer: 4e-5, ink: 0.3});
        tools.draw(shapes.threads, gl.LINES);
        gl.disable(gl.BLEND);
      }
    } else {
      if (look.springs) {
        const own = scene.triangles ? {} : {plain: rgb('8E9196'), by_family: 0};
        tools.use(programs.rod, {...all, ...own, radius: scene.particles > 60 ? thin : 0.3 * bead});
        tools.draw(shapes.rods, gl.TRIANGLES);
      }
      tools.use(programs.ball, {...all, radius: scene.particles > 60 ? 0.4 * bead : bead});
      if (!scene.triangles) tools.draw(shapes.beads, gl.TRIANGLES);
    }
    tools.use(programs.ball, {
      ...all,
      radius: 1.25 * Math.max(2.2 * pixel, scene.triangles ? 0 : bead),
      plain: rgb(look.background[0] > 0.5 ? '34363B' : 'A9AFB6'),
      by_value: 0
    });
    tools.draw(shapes.pins, gl.TRIANGLES);
    if (lit && panel.path) {
      tools.use(
          programs.rod,
          {...all, points: panel.path.texture, radius: 0.7 * pixel, plain: rgb('6C7A91'), by_value: 0, by_family: 0});
      tools.draw(shapes.path, gl.TRIANGLES, Math.min(Math.floor(look.frame), panel.motion.method.frames - 1));
    }
    this.drawObstacles(programs, look.frame, all);
  }

  drawObstacles(programs, frame, all) {
    const {tools, scene} = this, last = scene.times.length - 1;
    const time = Math.min(frame, last), first = Math.floor(time), next = Math.min(first + 1, last);
    for (const {radius, centres} of scene.spheres) {
      const a = centres[Math.min(first, centres.length - 1)], b = centres[Math.min(next, centres.length - 1)];
      const ball = [...plus(a, time - first, minus(b, a)), radius];
      tools.use(programs.ball, {...all, ball, plain: rgb('B6BBC3'), by_value: 0});
      tools.draw(this.shapes.obstacle, tools.gl.TRIANGLES);
    }
  }
}
