/** Starts the page. */

import { readData, startSolver } from "./page";
import { Encodings } from "./solve/encodings";
import { Retriever } from "./solve/retrieve";
import { testing, type Api } from "./testing";
import { App } from "./ui/app";

declare global {
  interface Window {
    foonExplorer: Api;
  }
}

const data = readData();
const solver = startSolver();
const retriever = new Retriever(solver, new Encodings(data.encodings), data.diets);
const app = new App(data, retriever, solver);
window.foonExplorer = testing(retriever, solver, () => app.world);
app.start(document.getElementById("app") as HTMLElement);
