// The three dialogs: help, link, files.
import { KEYS } from "./keys.js";
import { address } from "./link.js";
import { say } from "./state.js";

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
    <p class="soft">All pictures are computed here, by the Rust libraries of the project. Nothing is sent anywhere.</p>`,
  );
}

export function share() {
  open(
    "A link to exactly this view",
    `<input class="link" readonly aria-label="Link"><div class="row"><button id="copy">Copy</button></div>`,
  );
  dialog.querySelector(".link").value = address();
  dialog.querySelector("#copy").onclick = async () => {
    dialog.querySelector(".link").select();
    try {
      await navigator.clipboard.writeText(address());
      say("The link is copied.");
    } catch {
      say("Copy the marked link with Ctrl-C.");
    }
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
