/** Elements, made by hand: texts become text nodes and nothing else, whatever is in them. */

type Child = Node | string | number | null | undefined | false | readonly Child[];
type Handler = (event: Event) => void;
export type Properties = Readonly<Record<string, string | number | boolean | null | undefined | Handler>>;

const SVG = "http://www.w3.org/2000/svg";

/** Make an element: a function is a listener, true an attribute without a value, false and null none. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, properties: Properties = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, properties, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, properties: Properties = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  fill(element, properties, children);
  return element;
}

function fill(element: Element, properties: Properties, children: readonly Child[]): void {
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  append(element, children);
}

export function append(element: Element, children: readonly Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    if (Array.isArray(child)) append(element, child as readonly Child[]);
    else element.append(child instanceof Node ? child : String(child as string | number));
  }
}

/** Replace what an element holds, and leave the keyboard where it was: at the element with the same key. */
export function refill(element: Element, ...children: Child[]): void {
  const active = document.activeElement;
  const key = active !== null && element.contains(active) ? active.getAttribute("data-key") : null;
  element.replaceChildren();
  append(element, children);
  if (key !== null) element.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
}

export const counted = (count: number, what: string, more = `${what}s`): string => `${count.toLocaleString("en")} ${count === 1 ? what : more}`;

export function button(text: string, click: () => void, properties: Properties = {}): HTMLButtonElement {
  return h("button", { type: "button", click, "data-key": text, ...properties }, text);
}

/** Give the person a text as a file. */
export function save(name: string, text: string, type = "text/plain"): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
