// Wheel, drag, pinch and box. Each tells the page a factor for M, a factor for α, or a movement.
import { MARGIN } from "./axes.js";

/** Zoom of one line of a wheel. */
const WHEEL = 0.0016;
/** A press that moves less is a click, in pixels. */
const CLICK = 4;
/** A box smaller than this is a slip. */
const SMALLEST_BOX = 8;

/** A second click or tap within these milliseconds and pixels makes the two one gesture. */
const [TWICE, NEAR] = [350, 24];
/** A plane that was moved this many milliseconds before it is let go is thrown, with the speed of these. */
const THROWN = 80;

export function gestures(canvas, { zoom, move, click, twice, thrown, hover, box }) {
  const at = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { left: event.clientX - left - MARGIN.left, top: event.clientY - top - MARGIN.top };
  };
  const fingers = new Map();
  let start = null;
  let before = null; // the last click
  let trail = []; // places of the last milliseconds of a drag

  canvas.addEventListener(
    "wheel",
    (event) => {
      // Within another page the wheel scrolls that page, until the picture is clicked.
      if (document.body.classList.contains("embedded") && !event.ctrlKey && document.activeElement !== canvas) return;
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
    const last = fingers.get(event.pointerId);
    if (!last) return hover(now);
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      pinch(last, now, other);
    } else if (start) {
      start.moved ||= Math.hypot(now.left - start.left, now.top - start.top) > CLICK;
      trail = [...trail.filter(({ time }) => event.timeStamp - time < THROWN), { ...now, time: event.timeStamp }];
      if (start.moved && !start.boxed) move(now.left - last.left, now.top - last.top);
      if (start.moved && start.boxed) box(start, now, false);
    }
    fingers.set(event.pointerId, now);
  });

  const up = (event) => {
    const now = at(event);
    if (start && event.type === "pointerup") {
      if (!start.moved) {
        const again = before && event.timeStamp - before.time < TWICE && Math.hypot(now.left - before.left, now.top - before.top) < NEAR;
        before = again ? null : { ...now, time: event.timeStamp };
        if (again) twice(now);
        else click(now);
      }
      else if (start.boxed) {
        const large = Math.min(Math.abs(now.left - start.left), Math.abs(now.top - start.top)) > SMALLEST_BOX;
        box(start, now, true, large);
      } else {
        const [first] = trail.filter(({ time }) => event.timeStamp - time < THROWN);
        const time = first ? event.timeStamp - first.time : 0;
        if (time > 0) thrown((now.left - first.left) / time, (now.top - first.top) / time);
      }
    }
    trail = [];
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
