/** The bar at the top, and what is inside the page. */

import { readLicences } from "../page";
import type { App } from "./app";
import { button, counted, h } from "./dom";

export function header(app: App): Node[] {
  const { row } = app.plain;
  const chooser = h("input", {
    type: "file",
    accept: ".json,application/json",
    class: "unseen",
    id: "own-foon",
    tabindex: -1,
    "aria-label": "A FOON in JSON",
    change: () => {
      const file = chooser.files?.[0];
      if (file !== undefined) void app.open(file);
    },
  });
  return [
    h("h1", {}, h("span", { class: "mark", "aria-hidden": "true" }), "FOON explorer"),
    h(
      "p",
      { class: "data" },
      h("strong", {}, row.title),
      ` ${counted(app.plain.units.length, "functional unit")}, ${counted(new Set(app.plain.units.flatMap((_, unit) => app.plain.listed(unit))).size, "object")}`,
    ),
    h(
      "div",
      { class: "actions" },
      app.opened && button("Back to the first FOON", () => app.goBack(), { class: "plain" }),
      chooser,
      button("Open a FOON…", () => chooser.click(), { class: "plain", title: "A FOON of your own, in JSON; or drop it on the page. It stays on this machine." }),
      button("Copy link", () => void copyLink(app), { class: "plain" }),
      button("About", () => document.querySelector<HTMLDialogElement>("#about")?.showModal(), { class: "plain" }),
    ),
  ];
}

async function copyLink(app: App): Promise<void> {
  try {
    await navigator.clipboard.writeText(location.href);
    app.notice = "The address of this page, with all that is asked, is copied.";
  } catch {
    app.notice = "The address bar has the link: it holds all that is asked.";
  }
  app.say(app.notice);
  app.render();
}

export function about(): HTMLDialogElement {
  const dialog = h(
    "dialog",
    { id: "about", class: "about", "aria-labelledby": "about-title" },
    h("h2", { id: "about-title" }, "About this page"),
    h(
      "p",
      {},
      "This file holds a FOON, a kitchen, the answer-set encodings of foon_asp and the solver clingo. Everything is worked out here, in the browser: nothing is sent anywhere, and it works offline.",
    ),
    h("p", {}, "Green are object nodes, red are motion nodes, as in the papers on functional object-oriented networks."),
    h("h3", {}, "What is inside"),
    h("pre", { tabindex: 0, role: "region", "aria-label": "Licences" }, readLicences()),
    h("form", { method: "dialog" }, h("button", { class: "primary", autofocus: true }, "Close")),
  );
  return dialog;
}
