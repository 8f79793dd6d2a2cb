// Doors of the lab: its state in an address, as a file, as a command line.
// @ts-nocheck

import {make} from '../player/controls';
import {bytesOf} from '../player/unpack';

const inBase64 = bytes => btoa(Array.from(bytes, b => String.fromCharCode(b)).join(''))
                              .replace(/\+/g, '-')
                              .replace(/\//g, '_')
                              .replace(/=+$/, '');
const fromBase64 = text => bytesOf(text.replace(/-/g, '+').replace(/_/g, '/'));

const through = (bytes, stream) =>
    new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer().then(b => new Uint8Array(b));

/** A state as the part of an address behind "#lab=": JSON in base64, gzipped where it is long. */
export async function addressOf(state) {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  return inBase64(bytes.length > 900 ? await through(bytes, new CompressionStream('gzip')) : bytes);
}

/** The state of an address; null where it has none, or cannot be read. */
export async function stateOf(hash) {
  const packed = /^#lab=([\w-]+)/.exec(hash)?.[1];
  if (!packed) return null;
  try {
    const bytes = fromBase64(packed);
    const plain =
        bytes[0] === 0x1f && bytes[1] === 0x8b ? await through(bytes, new DecompressionStream('gzip')) : bytes;
    return JSON.parse(new TextDecoder().decode(plain));
  } catch {
    return null;
  }
}

/** Hands a text to the reader as a file. */
export function saveText(name, text) {
  const link = make('a', {download: name, href: URL.createObjectURL(new Blob([text], {type: 'application/toml'}))});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Copies a text; false where the browser does not allow it. */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // without the right to the clipboard (pages of a folder) a selection is copied
    const box = make('textarea', {class: 'copied', 'aria-hidden': 'true'});
    box.value = text;
    document.body.append(box);
    box.select();
    const done = document.execCommand('copy');
    box.remove();
    return done;
  }
}

/** The native program's command line of a method in a scene. */
export const commandOf = (scene, {method, step, tolerance}) =>
    `crosscheck run ${scene} --method ${method} ${tolerance ? `--tol ${tolerance}` : `--step ${step}`}`;
