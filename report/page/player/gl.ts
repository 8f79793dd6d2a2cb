import {header, vertexCommon} from './shaders';

export const noContext = new Error('no WebGL2 context');

export interface Program {
  program: WebGLProgram;
  places: Record<string, {at: WebGLUniformLocation, type: number}>;
}
export type Uniforms = Record<string, number|number[]|WebGLTexture|undefined|null>;

/** Corners for all instances, one row of `ints` integers per instance, and indices of corners. */
export interface Mesh {
  corners?: Float32Array;
  size?: number;  // numbers per corner
  instances?: Int32Array;
  slot?: number;  // attribute location of the instances
  ints?: number;
  index: Uint16Array;
}
export interface Shape {
  array: WebGLVertexArrayObject|null;
  indexed: number;
  instances: number;
}
/** A texture with four floats per entry. */
export interface Table {
  texture: WebGLTexture;
  wide: number;
  high: number;
  data: Float32Array;
}

export class Gl {
  readonly gl: WebGL2RenderingContext;

  /** Throws `noContext` if WebGL provides no context. */
  constructor(canvas: HTMLCanvasElement, antialias: boolean) {
    const gl = canvas.getContext('webgl2', {antialias, alpha: false, powerPreference: 'low-power'});
    if (!gl) throw noContext;
    this.gl = gl;
  }

  // After the context is lost, WebGL returns null for new objects. These nulls are passed on, and nothing is drawn.

  program(vertex: string, fragment: string, define = ''): Program {
    const gl = this.gl, program = gl.createProgram()!;
    const parts: [number, string][] = [[gl.VERTEX_SHADER, vertexCommon + vertex], [gl.FRAGMENT_SHADER, fragment]];
    for (const [kind, text] of parts) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, header + define + text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    ['corner', 'which', 'ends'].forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    // without this check, an error would leave a blank canvas and no message
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error([
        gl.getProgramInfoLog(program), ...(gl.getAttachedShaders(program) ?? []).map(s => gl.getShaderInfoLog(s))
      ].join(' '));
    const places: Program['places'] = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const {name, type} = gl.getActiveUniform(program, i)!;
      places[name.replace('[0]', '')] = {at: gl.getUniformLocation(program, name)!, type};
    }
    return {program, places};
  }

  /** Makes a program current, sets the uniforms that it has, and binds textures to units in order. */
  use({program, places}: Program, uniforms: Uniforms) {
    const gl = this.gl;
    gl.useProgram(program);
    let unit = 0;
    for (const [name, {at, type}] of Object.entries(places)) {
      const value = uniforms[name];
      if (value === undefined || value === null) continue;
      if (Array.isArray(value)) {
        if (type === gl.FLOAT_MAT4)
          gl.uniformMatrix4fv(at, false, value);
        else if (type === gl.FLOAT_VEC3)
          gl.uniform3fv(at, value);
        else
          gl.uniform4fv(at, value);
      } else if (typeof value === 'number')
        gl.uniform1f(at, value);
      else {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value);
        gl.uniform1i(at, unit++);
      }
    }
  }

  private buffer(target: number, data: Float32Array|Int32Array|Uint16Array) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
  }

  shape({corners, size = 1, instances, slot = 0, ints = 1, index}: Mesh): Shape {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    if (corners) {
      this.buffer(gl.ARRAY_BUFFER, corners);
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, size, gl.FLOAT, false, 0, 0);
    }
    if (instances) {
      this.buffer(gl.ARRAY_BUFFER, instances);
      gl.enableVertexAttribArray(slot);
      gl.vertexAttribIPointer(slot, ints, gl.INT, 0, 0);
      gl.vertexAttribDivisor(slot, 1);
    }
    this.buffer(gl.ELEMENT_ARRAY_BUFFER, index);
    gl.bindVertexArray(null);
    return {array, indexed: index.length, instances: instances ? instances.length / ints : 1};
  }

  draw({array, indexed, instances}: Shape, mode: number, count = instances) {
    this.gl.bindVertexArray(array);
    if (count > 0) this.gl.drawElementsInstanced(mode, indexed, this.gl.UNSIGNED_SHORT, 0, count);
  }

  /** A texture to be read texel by texel. */
  table(count: number): Table {
    const gl = this.gl, wide = Math.min(count, 1024), high = Math.ceil(count / wide);
    const texture = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, wide, high);
    for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, gl.NEAREST);
    return {texture, wide, high, data: new Float32Array(4 * wide * high)};
  }

  fill({texture, wide, high, data}: Table) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, wide, high, gl.RGBA, gl.FLOAT, data);
  }

  /** A row of colours (four bytes each), which is read with interpolation. */
  colours(bytes: Uint8Array) {
    const gl = this.gl, texture = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, bytes.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    for (const [key, value] of [
             [gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
             [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, key, value);
    return texture;
  }

  /** A depth texture with comparison, and its framebuffer. */
  shadowMap(size: number) {
    const gl = this.gl, texture = gl.createTexture()!, frame = gl.createFramebuffer();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    for (const [key, value] of [
             [gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
             [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE], [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL],
             [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, key, value);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return {texture, frame, size};
  }
}
