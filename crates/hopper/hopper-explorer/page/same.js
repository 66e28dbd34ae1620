// The same in Rust, in Python and on the command line, ready to copy.
import { isShares } from "./tiles.js";
import { layers, say, state } from "./state.js";
import { toM } from "./view.js";

export function snippets() {
  const { pin, view, hops, layer } = state;
  // At an edge of grounding there is nothing to zoom into.
  const depth = state.depth?.about?.kind === "grounding" ? null : state.depth;
  const own = layer === 0 || isShares(layer) ? null : layers[layer].key;
  // The model has no M = 0 and no α = 0: a window from there begins at a thousandth of its end.
  const positive = ([low, high]) => [low > 0 ? low : high / 1000, high];
  const [left, right] = positive(view.x.map((x) => toM(view, x)));
  const [bottom, top] = positive(view.alpha);
  const point = pin ?? { m: 0.2, alpha: 7 };
  const picture = depth
    ? `hopper zoom ${depth.m} ${depth.alpha} --frames ${Math.ceil(depth.depth) + 1} --out zoom`
    : `hopper basins --mass-ratio ${left} ${right} --speed ${bottom} ${top}${own ? ` --layer ${own}` : ""} --out basins`;
  const float = (value) => (Number.isInteger(value) ? value.toFixed(1) : String(value));
  return {
    "Command line": `hopper orbit ${point.alpha} -M ${point.m} --hops ${hops} --motion motion.csv
${picture}`,
    Python: `import passive_hopper as hopper

m = hopper.LiftOffMap(${point.m})
print(m.fate(${point.alpha}))
print(m.orbit(${point.alpha}, hops=${hops}))
basins = hopper.basins(M=(${left}, ${right}), alpha=(${bottom}, ${top}), shape=(512, 512)${own ? `, layer="${own}"` : ""})`,
    Rust: `use hopper_basin::Fates;
use passive_hopper::MassRatio;

let fates = Fates::new(MassRatio::new(${float(point.m)})?)?;
println!("{:?}", fates.fate(${float(point.alpha)})?);
println!("{:?}", fates.map().hop(${float(point.alpha)})?);`,
  };
}

/** Fills a panel with the calls, each with a button that copies it. */
export function fill(box) {
  const one = ([name, code]) => {
    const [title, text, copy] = ["p", "pre", "button"].map((tag) => document.createElement(tag));
    title.textContent = name;
    text.textContent = code;
    Object.assign(text, { tabIndex: 0, role: "region", ariaLabel: name });
    copy.textContent = "Copy";
    const failed = () => say("The browser does not allow copying; mark the text.");
    copy.onclick = () => navigator.clipboard.writeText(code).then(() => say("Copied."), failed);
    return [title, text, copy];
  };
  box.replaceChildren(...Object.entries(snippets()).flatMap(one));
}
