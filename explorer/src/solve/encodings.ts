/** The encodings, as they are: what each includes, which predicates it looks at, and its parts. Mirrors `asp/encodings.py`. */

const INCLUDE = /^#include "([^"]+)"\.$/gm;
const LEFT_OUT = /%\*[\s\S]*?\*%|%[^\n]*|"(?:[^"\\]|\\.)*"/g;
const NAME = /(?<![#\w])_*[a-z]\w*/g;
const PART = /^#program (\w+)(?:\((\w+)\))?\.$/m;
/** Files that only say what needs/2 and makes/2 are. */
const READINGS = new Set(["units.lp", "vocabulary.lp"]);
const DETAILS = new Set(["input", "output", "object", "label", "state", "relation", "content", "utensil", "motion", "start", "end", "duration"]);

export class Encodings {
  constructor(private readonly texts: Readonly<Record<string, string>>) {}

  /** Encodings and all that they include, each once, and each behind what it includes. */
  files(names: Iterable<string>): string[] {
    const found = new Set<string>();
    const visit = (name: string): void => {
      if (found.has(name)) return;
      for (const [, other] of this.read(name).matchAll(INCLUDE)) visit(resolved(name, other!));
      found.add(name);
    };
    for (const name of names) visit(name);
    return [...found];
  }

  /** The text of some encodings and all that they include. */
  text(names: Iterable<string>): string {
    return this.files(names)
      .map((name) => this.read(name).replaceAll(INCLUDE, ""))
      .join("\n");
  }

  /** Whether some encodings look closer at units than at what they need and make. */
  lookCloser(names: Iterable<string>): boolean {
    return this.files(names)
      .filter((name) => !READINGS.has(name))
      .some((name) => (this.read(name).replaceAll(LEFT_OUT, " ").match(NAME) ?? []).some((each) => DETAILS.has(each)));
  }

  /**
   * The text of an encoding with its `#program` parts as one program: `bounds` says for which values of its parameter each
   * part is there. It is what grounding the parts one by one does, for a solver that takes a single program.
   */
  unrolled(name: string, bounds: Readonly<Record<string, readonly number[]>>): string {
    const [base = "", ...rest] = this.text([name]).split(new RegExp(PART, "m"));
    const pieces = [base];
    for (let place = 0; place + 2 < rest.length; place += 3) {
      const [part, parameter, text] = [rest[place]!, rest[place + 1], rest[place + 2]!];
      const rules = text.replaceAll(/%\*[\s\S]*?\*%|%[^\n]*/g, " ");
      const uses = new RegExp(`"(?:[^"\\\\]|\\\\.)*"|(?<![\\w#'])${parameter ?? "(?!)"}(?!\\w)`, "g");
      for (const value of bounds[part] ?? []) pieces.push(rules.replaceAll(uses, (found) => (found === parameter ? String(value) : found)));
    }
    return pieces.join("\n");
  }

  private read(name: string): string {
    const text = this.texts[name];
    if (text === undefined) throw new Error(`there is no encoding ${name}`);
    return text;
  }
}

function resolved(from: string, to: string): string {
  const parts = from.split("/").slice(0, -1);
  for (const part of to.split("/")) {
    if (part === "..") parts.pop();
    else parts.push(part);
  }
  return parts.join("/");
}
