// Turns and zooms a view by pointer, wheel and keys.

import {Orbit} from './orbit';

export const orbitKeys = (orbit: Orbit): Record<string, () => void> => ({
  ArrowLeft: () => orbit.turn(-0.12, 0),
  ArrowRight: () => orbit.turn(0.12, 0),
  ArrowUp: () => orbit.turn(0, 0.1),
  ArrowDown: () => orbit.turn(0, -0.1),
  '+': () => orbit.magnify(1.15),
  '=': () => orbit.magnify(1.15),
  '-': () => orbit.magnify(1 / 1.15),
  0: () => orbit.reset()
});

/** Without Control or focus, the wheel scrolls the page. */
export function attachWheel(layer: HTMLElement, orbit: () => Orbit, changed: () => void) {
  layer.addEventListener('wheel', event => {
    if (!event.ctrlKey && document.activeElement !== layer) return;
    event.preventDefault();
    orbit().magnify(Math.exp(-0.0015 * event.deltaY));
    changed();
  }, {passive: false});
}

/** A finger that moves sideways turns the view; up or down, it scrolls the page. */
export function attachPointerInput(layer: HTMLElement, orbit: Orbit, changed: () => void) {
  layer.addEventListener('pointerdown', event => layer.setPointerCapture(event.pointerId));
  layer.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    orbit.turn(-0.008 * event.movementX, 0.008 * event.movementY);
    changed();
  });
  attachWheel(layer, () => orbit, changed);
  const keys = orbitKeys(orbit);
  layer.addEventListener('keydown', event => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
    changed();
  });
}
