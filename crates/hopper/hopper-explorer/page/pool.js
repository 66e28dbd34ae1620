// Workers for tiles, and one for the panels. A worker that dies or stays silent is replaced, and its job goes to the
// next one.
import { Refusal } from "./core.js";

/** Milliseconds without a word after which a worker is replaced. A strip that takes longer is given up after a second try. */
const SILENCE = 15000;
/** The same for a worker whose job is not wanted any more. */
const STOPPING = 1500;

export class Pool {
  /** `module` gives a promise: workers load their scripts while it is compiled. They start at the first question, or by `warm`. */
  constructor(module, count) {
    this.module = module;
    this.next = 1;
    this.queue = [];
    this.members = Array.from({ length: count }, () => ({ worker: null, job: null, heard: 0 }));
    setInterval(() => this.#watch(), 1000);
  }

  warm() {
    this.members.filter(({ worker }) => !worker).forEach((member) => this.#start(member));
    return this;
  }

  #start(member) {
    member.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    member.worker.onmessage = ({ data }) => this.#hear(member, data);
    // An event without a message: the script itself did not come.
    member.worker.onerror = ({ message }) => this.#replace(member, message ?? "worker.js cannot be loaded");
    this.#tell(member, (module) => ({ module }));
  }

  /** Sends a message as soon as the module is there; messages keep their order. */
  #tell(member, message) {
    const { worker } = member;
    this.module().then(
      (module) => {
        worker.postMessage(message(module));
        member.heard = performance.now();
      },
      (error) => {
        // What does not load is asked for again by the next job.
        member.job?.fail(new Error(`a part of the page cannot be loaded: ${error.message}`));
        member.job = null;
      },
    );
  }

  #hear(member, { id, progress, found, error, refused }) {
    const job = member.job;
    if (!job || job.id !== id) return;
    member.heard = performance.now();
    if (progress !== undefined) return;
    if (error !== undefined && !refused) return this.#replace(member, error);
    member.job = null;
    if (error !== undefined) job.fail(new Refusal(error));
    else job.done(found);
    this.#feed();
  }

  /** Ends a worker. Its job is tried once more; the next job starts a new worker. */
  #replace(member, reason = "the worker does not answer") {
    member.worker.terminate();
    member.worker = null;
    const job = member.job;
    member.job = null;
    if (job) {
      job.tries += 1;
      if (job.tries < 2) this.queue.unshift(job);
      else job.fail(new Error(reason));
    }
    this.#feed();
  }

  #watch() {
    for (const member of this.members) {
      const silent = performance.now() - member.heard > SILENCE;
      if (member.job && silent) this.#replace(member);
      else if (member.job?.stopped && performance.now() - member.job.stopped > STOPPING) {
        member.job.done({ stopped: true });
        member.job = null;
        this.#replace(member);
      }
    }
  }

  #feed() {
    for (const member of this.members) {
      if (member.job || this.queue.length === 0) continue;
      if (!member.worker) this.#start(member);
      member.job = this.queue.shift();
      member.heard = Infinity; // until the question is sent
      const { id, kind, args } = member.job;
      this.#tell(member, () => ({ id, kind, args }));
    }
  }

  /** Asks for an answer. The promise has a number with which it can be stopped. */
  ask(kind, ...args) {
    const id = this.next++;
    const promise = new Promise((done, fail) => this.queue.push({ id, kind, args, done, fail, tries: 0 }));
    promise.id = id;
    this.#feed();
    return promise;
  }

  /** Gives a job up: it leaves the queue, or stops at its next strip. */
  stop(id) {
    const waiting = this.queue.findIndex((job) => job.id === id);
    if (waiting >= 0) {
      const [job] = this.queue.splice(waiting, 1);
      job.done({ stopped: true });
      return;
    }
    const member = this.members.find(({ job }) => job?.id === id);
    if (!member) return;
    member.job.stopped ??= performance.now();
    this.#tell(member, () => ({ stop: id }));
  }
}
