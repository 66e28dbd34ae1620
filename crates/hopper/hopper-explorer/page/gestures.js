// Wheel, drag, pinch and box. Each tells the page a factor for M, a factor for α, or a movement.
import { MARGIN } from "./axes.js";

/** Zoom of one line of a wheel. */
const WHEEL = 0.0016;
/** A press that moves less is a click, in pixels. */
const CLICK = 4;
/** A box smaller than this is a slip. */
const SMALLEST_BOX = 8;

export function gestures(canvas, { zoom, move, click, hover, box }) {
  const at = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { left: event.clientX - left - MARGIN.left, top: event.clientY - top - MARGIN.top };
  };
  const fingers = new Map();
  let start = null;

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      // With Shift a wheel scrolls sideways in some browsers.
      const turned = (event.deltaY || event.deltaX) * (event.deltaMode === 1 ? 30 : 1);
      // Pinching a touchpad is a wheel with Ctrl, in smaller steps.
      const factor = Math.exp(turned * WHEEL * (event.ctrlKey ? 5 : 1));
      zoom(at(event), event.shiftKey ? 1 : factor, event.altKey ? 1 : factor);
    },
    { passive: false },
  );

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    start = fingers.size === 1 ? { ...at(event), boxed: event.shiftKey, moved: false } : null;
    canvas.focus({ preventScroll: true });
  });

  canvas.addEventListener("pointermove", (event) => {
    const now = at(event);
    const before = fingers.get(event.pointerId);
    if (!before) return hover(now);
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      pinch(before, now, other);
    } else if (start) {
      start.moved ||= Math.hypot(now.left - start.left, now.top - start.top) > CLICK;
      if (start.moved && !start.boxed) move(now.left - before.left, now.top - before.top);
      if (start.moved && start.boxed) box(start, now, false);
    }
    fingers.set(event.pointerId, now);
  });

  const up = (event) => {
    const now = at(event);
    if (start && event.type === "pointerup") {
      if (!start.moved) click(now);
      else if (start.boxed) {
        const large = Math.min(Math.abs(now.left - start.left), Math.abs(now.top - start.top)) > SMALLEST_BOX;
        box(start, now, true, large);
      }
    }
    start = null;
    fingers.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);

  /** Two fingers zoom each axis by the change of their distance along it; along an axis on which they are close, both alike. */
  function pinch(before, now, other) {
    const middle = { left: (now.left + other.left) / 2, top: (now.top + other.top) / 2 };
    const both =
      Math.hypot(before.left - other.left, before.top - other.top) /
      Math.hypot(now.left - other.left, now.top - other.top);
    const along = (old, fresh) => (Math.min(Math.abs(old), Math.abs(fresh)) > 60 ? Math.abs(old / fresh) : both);
    zoom(
      middle,
      along(before.left - other.left, now.left - other.left),
      along(before.top - other.top, now.top - other.top),
    );
    move((now.left - before.left) / 2, (now.top - before.top) / 2);
  }
}
