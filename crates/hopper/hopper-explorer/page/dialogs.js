// The dialogs: help, link, places, files.
import { KEYS, letters, useLetters } from "./keys.js";
import { address } from "./link.js";
import { change, say } from "./state.js";
import { stops } from "./tour.js";

const dialog = document.getElementById("dialog");

function open(title, content) {
  dialog.innerHTML = `<h2 id="dialog-title">${title}</h2>${content}<div class="row"><button id="close" autofocus>Close</button></div>`;
  dialog.querySelector("#close").onclick = () => dialog.close();
  if (!dialog.open) dialog.showModal();
}

export function help() {
  const rows = KEYS.map(([key, what]) => `<tr><td><kbd>${key}</kbd></td><td>${what}</td></tr>`).join("");
  open(
    "Keys and gestures",
    `<p>Wheel or pinch: zoom to the cursor. With <kbd>Shift</kbd> only α, with <kbd>Alt</kbd> only M. Drag: move.
    <kbd>Shift</kbd> and drag: a box. Click: pin a point.</p><table>${rows}</table>
    <p><label><input id="letters" type="checkbox"${letters() ? " checked" : ""}> single letters and digits are keys</label></p>
    <p class="soft">All pictures are computed here, by the Rust libraries of the project. Nothing is sent anywhere.</p>`,
  );
  dialog.querySelector("#letters").onchange = ({ target }) => useLetters(target.checked);
}

/** A text that is marked and copied. */
const copied = (title, id, rows = 1) =>
  `<h3>${title}</h3><textarea class="link" id="${id}" rows="${rows}" readonly aria-label="${title}"></textarea><div class="row"><button data-copy="${id}">Copy</button></div>`;

export function share() {
  const texts = {
    link: address(),
    frame: `<iframe src="${address()}&embed" title="Basins of a passive hopper" width="720" height="480"></iframe>`,
    citation: `The hybrid-hopper authors. Hopper explorer (2026). ${address()}`,
  };
  open(
    "A link to exactly this view",
    copied("Link", "link", 3) + copied("For another page", "frame", 4) + copied("To cite", "citation", 4),
  );
  for (const [id, text] of Object.entries(texts)) {
    const box = dialog.querySelector(`#${id}`);
    box.value = text;
    dialog.querySelector(`[data-copy="${id}"]`).onclick = async () => {
      box.select();
      try {
        await navigator.clipboard.writeText(text);
        say("It is copied.");
      } catch {
        say("Copy the marked text with Ctrl-C.");
      }
    };
  }
}

/** Where the reader's own places are kept, in this browser alone. */
const PLACES = "hopper-explorer places";
const own = () => {
  try {
    return JSON.parse(localStorage.getItem(PLACES) ?? "[]");
  } catch {
    return [];
  }
};
const keepPlaces = (all) => {
  try {
    localStorage.setItem(PLACES, JSON.stringify(all));
  } catch {
    say("This browser keeps nothing for this page.");
  }
};

/** Places with names: those of the tour, and the reader's own. `follow` shows an address, `openDepth` an edge. */
export function places(follow, legend, openDepth) {
  open(
    "Places",
    `<ul class="places"></ul><form class="row"><label>This view as <input id="place" maxlength="60" required></label><button>Keep</button></form>`,
  );
  const list = dialog.querySelector("ul");
  const row = (name, go, remove) => {
    const [item, button] = ["li", "button"].map((tag) => document.createElement(tag));
    button.textContent = name;
    button.onclick = () => {
      dialog.close();
      go();
    };
    item.append(button);
    if (remove) {
      const away = document.createElement("button");
      Object.assign(away, { textContent: "×", ariaLabel: `Remove ${name}`, onclick: remove });
      item.append(" ", away);
    }
    list.append(item);
  };
  const fill = () => {
    list.replaceChildren();
    for (const { title, fields, depth } of stops(legend))
      row(title, () => {
        change(fields);
        if (depth) openDepth(depth.m, depth.alpha, depth.depth);
      });
    own().forEach(({ name, hash }, k) =>
      row(
        name,
        () => follow(hash),
        () => {
          keepPlaces(own().filter((_, other) => other !== k));
          fill();
        },
      ),
    );
  };
  fill();
  dialog.querySelector("form").onsubmit = (event) => {
    event.preventDefault();
    const name = dialog.querySelector("#place").value.trim();
    if (!name) return;
    keepPlaces([...own(), { name, hash: address().slice(address().indexOf("#")) }]);
    event.target.reset();
    fill();
  };
}

/** `files` are pairs of a name and a function that saves. Its argument shows a text, and says whether the file is still wanted. */
export function save(files) {
  open(
    "Save what is seen",
    `<p class="soft">Each file holds its parameters and the link to this view.</p>
    <div class="row">${files.map(([name], k) => `<button data-file="${k}">${name}</button>`).join("")}</div><p id="saved" aria-live="polite"></p>`,
  );
  dialog.querySelectorAll("[data-file]").forEach((button) => {
    button.onclick = async () => {
      const saved = dialog.querySelector("#saved");
      // A file that waits is given up with its dialog.
      const tell = (text) => {
        saved.textContent = text;
        return saved.isConnected && dialog.open;
      };
      try {
        tell("Computing …");
        await files[Number(button.dataset.file)][1](tell);
        tell("Saved.");
      } catch (error) {
        tell(`Not saved: ${error.message}.`);
      }
    };
  });
}
