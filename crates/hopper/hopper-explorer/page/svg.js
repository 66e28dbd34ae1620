// Small drawings as SVG text: a frame with axes, curves and bands.
import { ticks } from "./numbers.js";

const WIDTH = 400;

export class Drawing {
  /** Ranges of both axes; the names of the axes may hold markup. */
  constructor({ x, y, height = 260, xName = "", yName = "", title, margin = [44, 34] }) {
    const [left, bottom] = margin;
    Object.assign(this, { x, y, height, title, left, right: WIDTH - 8, top: 10, bottom: height - bottom });
    this.parts = [];
    this.axes = [];
    for (const { at, label } of ticks(x, 6).marks) {
      const [px] = this.at(at, y[0]);
      this.axes.push(
        `<path d="M${px} ${this.bottom}v4" stroke="currentColor"/><text x="${px}" y="${this.bottom + 15}" text-anchor="middle">${label}</text>`,
      );
    }
    for (const { at, label } of ticks(y, height / 45).marks) {
      const [, py] = this.at(x[0], at);
      this.axes.push(
        `<path d="M${this.left} ${py}h-4" stroke="currentColor"/><text x="${this.left - 6}" y="${py + 4}" text-anchor="end">${label}</text>`,
      );
    }
    const middle = (this.top + this.bottom) / 2;
    this.axes.push(`<text x="${(this.left + this.right) / 2}" y="${height - 4}" text-anchor="middle">${xName}</text>`);
    this.axes.push(
      `<text x="10" y="${middle}" text-anchor="middle" transform="rotate(-90 10 ${middle})">${yName}</text>`,
    );
  }

  at(x, y) {
    const px = this.left + ((x - this.x[0]) / (this.x[1] - this.x[0])) * (this.right - this.left);
    const py = this.bottom - ((y - this.y[0]) / (this.y[1] - this.y[0])) * (this.bottom - this.top);
    return [px.toFixed(2), py.toFixed(2)].map(Number);
  }

  curve(points, color, width = 1.4, more = "") {
    if (points.length > 1) {
      const path = points.map(([x, y]) => this.at(x, y).join(" ")).join("L");
      this.parts.push(
        `<path d="M${path}" fill="none" stroke="${color}" stroke-width="${width}" stroke-linejoin="round" ${more}/>`,
      );
    }
    return this;
  }

  band(from, to, color, more = "") {
    const [left] = this.at(Math.max(from, this.x[0]), 0);
    const [right] = this.at(Math.min(to, this.x[1]), 0);
    if (right >= left)
      this.parts.push(
        `<rect x="${left}" y="${this.top}" width="${Math.max(right - left, 0.8)}" height="${this.bottom - this.top}" fill="${color}" ${more}/>`,
      );
    return this;
  }

  dot(x, y, color, radius = 3) {
    const [px, py] = this.at(x, y);
    this.parts.push(`<circle cx="${px}" cy="${py}" r="${radius}" fill="${color}"/>`);
    return this;
  }

  text(x, y, label, anchor = "start") {
    const [px, py] = this.at(x, y);
    this.parts.push(`<text x="${px}" y="${py}" text-anchor="${anchor}">${label}</text>`);
    return this;
  }

  /** The drawing as markup; `extra` lies inside the frame. */
  markup(extra = "") {
    const clip = `clip${Math.random().toString(36).slice(2)}`;
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${this.height}" role="img"><title>${this.title}</title>` +
      `<clipPath id="${clip}"><rect x="${this.left}" y="${this.top}" width="${this.right - this.left}" height="${this.bottom - this.top}"/></clipPath>` +
      `<g clip-path="url(#${clip})">${this.parts.join("")}${extra}</g>` +
      `<rect x="${this.left}" y="${this.top}" width="${this.right - this.left}" height="${this.bottom - this.top}" fill="none" stroke="currentColor"/>` +
      `${this.axes.join("")}</svg>`
    );
  }
}
