// The lab's state as an address, a file, or a command line.

import {make} from '../player/controls';
import {bytesOf} from '../player/unpack';

import {Changes, MethodSpec} from './scene_text';

// missing from TypeScript's library
declare const CompressionStream: new (format: 'gzip') => GenericTransformStream;
declare const DecompressionStream: typeof CompressionStream;

/** A state of the lab, as in links and for setState(). */
export interface LabState {
  scene?: string;
  toml?: string;      // default: the shipped text
  changes?: Changes;  // numbers to change in the text
  methods?: MethodSpec[]|null;
  view?: 'over'|'side';
  colour?: 'plain'|'stretch'|'error';
  springs?: boolean;
  truth?: boolean;
  speed?: number;
  running?: boolean;
}

const inBase64 = (bytes: Uint8Array) => btoa(Array.from(bytes, b => String.fromCharCode(b)).join(''))
                                            .replace(/\+/g, '-')
                                            .replace(/\//g, '_')
                                            .replace(/=+$/, '');
const fromBase64 = (text: string): Uint8Array => bytesOf(text.replace(/-/g, '+').replace(/_/g, '/'));

const through = async (bytes: Uint8Array, stream: GenericTransformStream) =>
    new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/** The part of an address after "#lab=": JSON in base64, gzipped if it is long. */
export async function addressOf(state: LabState) {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  return inBase64(bytes.length > 900 ? await through(bytes, new CompressionStream('gzip')) : bytes);
}

/** The state in an address; null if it contains no readable state. */
export async function stateOf(hash: string): Promise<LabState|null> {
  const packed = /^#lab=([\w-]+)/.exec(hash)?.[1];
  if (!packed) return null;
  try {
    const bytes = fromBase64(packed), gzip = bytes[0] === 0x1f && bytes[1] === 0x8b;
    const plain = gzip ? await through(bytes, new DecompressionStream('gzip')) : bytes;
    return JSON.parse(new TextDecoder().decode(plain));
  } catch {
    return null;
  }
}

export function saveText(name: string, text: string) {
  const link = make('a', {download: name, href: URL.createObjectURL(new Blob([text], {type: 'application/toml'}))});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Returns false if the browser does not allow it. */
export async function copyText(text: string) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // pages opened from a folder have no access to the clipboard: copy a selection
    const box = make('textarea', {class: 'copied', 'aria-hidden': 'true'});
    box.value = text;
    document.body.append(box);
    box.select();
    const done = document.execCommand('copy');
    box.remove();
    return done;
  }
}

/** Command that runs a method with the native program. */
export const commandOf = (scene: string, {method, step, tolerance}: MethodSpec) =>
    `crosscheck run ${scene} --method ${method} ${tolerance ? `--tol ${tolerance}` : `--step ${step}`}`;
