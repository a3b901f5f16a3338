// The editor of the case: colours, numbers of lines, and the line of an error.

const TOKENS = /(#[^\n]*)|("(?:[^"\\\n]|\\.)*"?)|(^[ \t]*\[\[?[^\]\n]*\]?\]?)|\b(true|false)\b|([+-]?\b\d[\d_]*(?:\.\d+)?(?:e[+-]?\d+)?\b)/gim;
const KINDS = ["comment", "text", "section", "number", "number"];

class Editor {
  constructor(area, changed) {
    this.area = area;
    this.under = area.parentElement.querySelector(".under");
    this.numbers = area.closest(".editor").querySelector(".numbers");
    this.line = null;
    area.addEventListener("input", () => {
      this.line = null;
      this.draw();
      changed();
    });
    area.addEventListener("keydown", (event) => this.key(event));
  }

  get text() {
    return this.area.value;
  }

  set text(text) {
    this.area.value = text;
    this.line = null;
    this.draw();
  }

  // Marks a line, counted from 1, and shows it; null marks none.
  mark(line, column = 1) {
    this.line = line;
    this.draw();
    if (line === null) return;
    this.column = column;
    const height = parseFloat(getComputedStyle(this.area).lineHeight);
    const box = this.area.closest(".editor");
    box.scrollTop = Math.max(0, (line - 4) * height);
  }

  draw() {
    const lines = this.text.split("\n");
    this.under.replaceChildren(...coloured(this.text));
    this.numbers.replaceChildren(...lines.map((_, place) => {
      const number = document.createElement("span");
      number.textContent = place + 1;
      number.className = place + 1 === this.line ? "wrong" : "";
      return number;
    }));
    this.area.style.height = "auto";
    this.area.style.height = `${this.area.scrollHeight}px`;
  }

  // A tab is two spaces; Escape leaves the editor.
  key(event) {
    if (event.key === "Escape") this.area.blur();
    if (event.key !== "Tab" || event.shiftKey) return;
    event.preventDefault();
    this.area.setRangeText("  ", this.area.selectionStart, this.area.selectionEnd, "end");
    this.area.dispatchEvent(new Event("input"));
  }
}

function coloured(text) {
  const nodes = [];
  let at = 0;
  for (const found of text.matchAll(TOKENS)) {
    nodes.push(text.slice(at, found.index));
    const span = document.createElement("span");
    span.className = KINDS[found.slice(1).findIndex((it) => it !== undefined)];
    span.textContent = found[0];
    nodes.push(span);
    at = found.index + found[0].length;
  }
  nodes.push(`${text.slice(at)}\n`);
  return nodes;
}

// Where the value of a key stands in a case: of `material.young` the first in [material], of `load.displacement.y` that in the braces. Null
// where it is not.
function placeOfKey(text, path) {
  const [section, key, inner] = path.split(".");
  const number = "([+-]?[\\d._]+(?:e[+-]?\\d+)?)";
  const before = inner ? `${key}\\s*=\\s*\\{[^}\\n]*\\b${inner}\\s*=\\s*` : `${key}\\s*=\\s*`;
  const pattern = new RegExp(`(^\\s*\\[\\[?${section}\\]\\]?[^\\n]*\\n(?:(?!\\s*\\[)[^\\n]*\\n)*?\\s*${before})${number}`, "im");
  const found = pattern.exec(text);
  if (!found) return null;
  const from = found.index + found[1].length;
  return { from, to: from + found[2].length, value: Number(found[2].replaceAll("_", "")) };
}
