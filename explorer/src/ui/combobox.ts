/** A field with suggestions, for keyboard, pointer and screen reader alike (the ARIA combobox with a list). */

import { h, refill } from "./dom";

export interface Suggestion {
  readonly value: string;
  /** What is shown: elements without anything to press. */
  readonly show: () => readonly (Node | string)[];
}

export interface ComboboxOptions {
  readonly id: string;
  readonly label: string;
  readonly placeholder?: string;
  readonly hiddenLabel?: boolean;
  readonly large?: boolean;
  readonly suggest: (text: string) => readonly Suggestion[];
  readonly choose: (value: string) => void;
  readonly nothing?: string;
}

export function combobox(options: ComboboxOptions): HTMLElement {
  const { id, suggest, choose } = options;
  let shown: readonly Suggestion[] = [];
  let active = -1;
  const list = h("ul", { id: `${id}-list`, role: "listbox", class: "suggestions", "aria-label": options.label, hidden: true });
  const input = h("input", {
    id,
    type: "text",
    role: "combobox",
    "aria-expanded": "false",
    "aria-controls": `${id}-list`,
    "aria-autocomplete": "list",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: options.placeholder,
    "data-key": id,
    input: () => open(),
    focus: () => input.value !== "" && open(),
    blur: () => close(),
    keydown: (event) => press(event as KeyboardEvent),
  });
  const empty = h("p", { class: "suggestions nothing", role: "status", hidden: true }, options.nothing ?? "Nothing is called like that.");

  function open(): void {
    shown = suggest(input.value);
    active = shown.length > 0 && input.value !== "" ? 0 : -1;
    refill(
      list,
      shown.map((each, place) =>
        h(
          "li",
          {
            role: "option",
            id: `${id}-${place}`,
            "aria-selected": place === active ? "true" : "false",
            pointerdown: (event) => {
              event.preventDefault();
              pick(place);
            },
          },
          each.show(),
        ),
      ),
    );
    list.hidden = shown.length === 0;
    empty.hidden = shown.length > 0 || input.value.trim() === "";
    mark();
  }

  function close(): void {
    list.hidden = true;
    empty.hidden = true;
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
  }

  function mark(): void {
    input.setAttribute("aria-expanded", list.hidden ? "false" : "true");
    [...list.children].forEach((item, place) => item.setAttribute("aria-selected", place === active ? "true" : "false"));
    if (active < 0) input.removeAttribute("aria-activedescendant");
    else {
      input.setAttribute("aria-activedescendant", `${id}-${active}`);
      list.children[active]?.scrollIntoView({ block: "nearest" });
    }
  }

  function pick(place: number): void {
    const chosen = shown[place];
    if (chosen === undefined) return;
    input.value = "";
    close();
    choose(chosen.value);
  }

  function press(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step !== undefined) {
      event.preventDefault();
      if (list.hidden) open();
      else active = (active + step + shown.length) % shown.length;
      mark();
    } else if (event.key === "Enter" && !list.hidden) {
      event.preventDefault();
      pick(active);
    } else if (event.key === "Escape" && !list.hidden) {
      event.stopPropagation();
      close();
    }
  }

  return h(
    "div",
    { class: options.large === true ? "combobox large" : "combobox" },
    h("label", { for: id, class: options.hiddenLabel === true ? "unseen" : "field" }, options.label),
    input,
    list,
    empty,
  );
}
