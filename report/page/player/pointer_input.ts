// Pointer, wheel and keys that turn and zoom a view.

import {Orbit} from './orbit';

/** Keys that turn and zoom. */
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

/** Lets the wheel zoom if the view has the focus, or with Control: otherwise the page scrolls over it. */
export function attachWheel(layer: HTMLElement, orbit: () => Orbit, changed: () => void) {
  layer.addEventListener('wheel', event => {
    if (!event.ctrlKey && document.activeElement !== layer) return;
    event.preventDefault();
    orbit().magnify(Math.exp(-0.0015 * event.deltaY));
    changed();
  }, {passive: false});
}

/**
 * Calls `changed` after each change of the orbit. A finger that moves up or down scrolls the page; a sideways movement
 * turns the view.
 */
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
