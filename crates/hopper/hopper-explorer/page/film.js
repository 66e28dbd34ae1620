// A zoom as a video: from the whole window to the present view, or down to the present depth. Each frame is computed before it is recorded.
import { SHALLOWEST } from "./deep.js";
import { change, state } from "./state.js";

/** Frames of a video, and the milliseconds for which each is shown: six seconds. */
const [FRAMES, SHOWN] = [90, 66];
/** The longest wait for the parts of a frame: what is missing then stays coarse. */
const LONGEST = 20000;
/** Formats, the best first. */
const FORMATS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/mp4"];

const pause = (time) => new Promise((done) => setTimeout(done, time));

/** The windows from one view to another: their sides change by equal factors, towards one point. */
function between(from, to) {
  const side = (a, b, part) => {
    const [wide, narrow] = [a[1] - a[0], b[1] - b[0]];
    if (Math.abs(wide - narrow) < 1e-12 * wide) return [0, 1].map((k) => a[k] + part * (b[k] - a[k]));
    const width = wide ** (1 - part) * narrow ** part;
    const moved = (width - narrow) / (wide - narrow);
    return [0, 1].map((k) => b[k] + moved * (a[k] - b[k]));
  };
  return (part) => ({ ...to, x: side(from.x, to.x, part), alpha: side(from.alpha, to.alpha, part) });
}

/** The states of the frames: from `home`, or from the shallowest depth. */
function path(home) {
  const { view, depth } = state;
  if (depth) {
    const first = Math.min(SHALLOWEST + 0.5, depth.depth);
    return (part) => ({ depth: { ...depth, depth: first + part * (depth.depth - first), shift: [0, 0] } });
  }
  const windows = between(home, view);
  return (part) => ({ view: windows(part) });
}

/** The video. `wait` shows a text, and says whether it is still wanted. */
export async function film(plane, home, wait) {
  const type = FORMATS.find((format) => window.MediaRecorder?.isTypeSupported(format));
  if (!type) throw new Error("this browser records no video");
  const before = { view: state.view, depth: state.depth };
  const at = path(home);
  const stream = plane.canvas.captureStream(0);
  const [track] = stream.getVideoTracks();
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 8e6 });
  const pieces = [];
  recorder.ondataavailable = ({ data }) => pieces.push(data);
  const ended = new Promise((done) => (recorder.onstop = done));
  recorder.start();
  recorder.pause();
  try {
    for (let frame = 0; frame < FRAMES; frame++) {
      change(at(frame / (FRAMES - 1)));
      if (!wait(`Frame ${frame + 1} of ${FRAMES} …`)) throw new Error("given up");
      await pause(30);
      for (let waited = 0; waited < LONGEST; waited += 30) {
        const { all, there, failed } = plane.parts;
        if (there + failed >= all) break;
        await pause(30);
      }
      plane.draw();
      recorder.resume();
      track.requestFrame();
      await pause(SHOWN);
      recorder.pause();
    }
  } finally {
    recorder.stop();
    await ended;
    track.stop();
    change(before);
  }
  return new Blob(pieces, { type });
}
