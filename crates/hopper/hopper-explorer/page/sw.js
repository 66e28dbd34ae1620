// Works offline: what was loaded once is kept. With a network, the newest files are taken.
const CACHE = "hopper-explorer";
const FILES = [
  "./",
  "index.html",
  "style.css",
  "screens.css",
  "icon.svg",
  "core.wasm",
  "deep.wasm",
  "systems.wasm",
  "main.js",
  "core.js",
  "column.js",
  "compare.js",
  "worker.js",
  "pool.js",
  "view.js",
  "tiles.js",
  "plane.js",
  "axes.js",
  "numbers.js",
  "others.js",
  "film.js",
  "gestures.js",
  "glide.js",
  "history.js",
  "keys.js",
  "large.js",
  "legend.js",
  "deep.js",
  "state.js",
  "link.js",
  "svg.js",
  "point_panel.js",
  "map_panel.js",
  "motion_panel.js",
  "circle_panel.js",
  "save.js",
  "png_text.js",
  "same.js",
  "tour.js",
  "dialogs.js",
];

self.addEventListener("install", (event) => {
  event.waitUntil(
    caches
      .open(CACHE)
      .then((cache) => cache.addAll(FILES))
      .then(() => self.skipWaiting()),
  );
});
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
self.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET" || new URL(event.request.url).origin !== location.origin) return;
  event.respondWith(
    fetch(event.request)
      .then(async (answer) => {
        if (answer.ok) (await caches.open(CACHE)).put(event.request, answer.clone());
        return answer;
      })
      .catch(async () => (await caches.match(event.request, { ignoreSearch: true })) ?? Response.error()),
  );
});
