/** The page: its state, what was answered, and the parts that show both. */

import type { PageData } from "../foon/data";
import { FileError, withFoon } from "../foon/read";
import { World } from "../foon/world";
import { Index } from "../search";
import { FREE, type Constraints } from "../solve/problem";
import type { Answer, Query } from "../solve/query";
import type { Progress, Retriever } from "../solve/retrieve";
import type { Solver } from "../solve/solver";
import { QueryError } from "../solve/tariff";
import { AS_IT_IS, START, readState, writeState, type KitchenChange, type State } from "../state";
import { askPanel } from "./ask";
import { closeDetail } from "./detail";
import { counted, h, refill } from "./dom";
import { mainView, tellProgress } from "./views";
import { about, header } from "./header";

export interface Running {
  readonly since: number;
  progress: Progress;
}

export class App {
  state: State;
  world: World;
  /** The world with the kitchen of the data. */
  plain: World;
  index: Index;
  answer: Answer | undefined;
  running: Running | undefined;
  /** What went wrong, in a sentence. */
  trouble = "";
  /** A word on what was just done, for everyone. */
  notice = "";
  /** What views keep for themselves as long as the question stays the same. */
  readonly kept = new Map<string, unknown>();
  /** Which parts of the question are folded open. */
  readonly folds = new Map<string, boolean>();
  private asked = "";
  private readonly head = h("header", { class: "bar" });
  private readonly side = h("section", { class: "ask", "aria-label": "Question" });
  private readonly main = h("main", { id: "answer", tabindex: -1 });
  private readonly columns = h("div", {}, this.side, this.main);
  private readonly live = h("p", { class: "unseen", role: "status", "aria-live": "polite" });
  private ticking: ReturnType<typeof setInterval> | undefined;

  constructor(
    readonly data: PageData,
    readonly retriever: Retriever,
    readonly solver: Solver,
  ) {
    this.plain = World.of(data.world);
    this.world = this.plain;
    this.index = new Index(this.plain);
    this.state = readState(location.hash.slice(1));
  }

  start(root: HTMLElement): void {
    const skip = h("a", { class: "skip", href: "#answer", click: (event) => (event.preventDefault(), this.main.focus()) }, "Skip to the answer");
    root.replaceChildren(skip, this.head, this.columns, this.live, about());
    window.addEventListener("hashchange", () => {
      const state = readState(location.hash.slice(1));
      if (writeState(state) !== writeState(this.state)) this.set(state, false);
    });
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      const file = event.dataTransfer?.files[0];
      if (file !== undefined) void this.open(file);
    });
    this.seeKitchen();
    this.render();
    void this.ask();
  }

  /** Change the state; what depends on it follows, the address too. */
  set(change: Partial<State>, remember = true): void {
    const before = this.state;
    this.state = { ...before, ...change };
    if (writeState(this.state) !== writeState(before)) {
      const address = `#${writeState(this.state)}`;
      if (remember) history.pushState(null, "", address);
    }
    if (JSON.stringify(this.state.kitchen) !== JSON.stringify(before.kitchen)) this.seeKitchen();
    this.render();
    void this.ask();
  }

  constrain(change: Partial<Constraints>): void {
    this.set({ constraints: { ...this.state.constraints, ...change }, tree: 0 });
  }

  /** Make an object, beside the other goals if there are to be several. */
  make(text: string, beside = false): void {
    closeDetail();
    const goals = beside ? [...new Set([...this.state.goals, text])] : [text];
    const view = this.state.view === "kitchen" ? "steps" : this.state.view;
    this.set({ goals, view, tree: 0, ...(goals.length > 1 ? { method: "optimal", founded: true } : {}) });
  }

  /** Put an object into the kitchen, or take it out. */
  stock(number: number, there: boolean): void {
    this.stockAll([number], there);
  }

  stockAll(numbers: readonly number[], there: boolean): void {
    const stock = new Set(this.world.stock);
    for (const number of numbers) {
      if (there) stock.add(number);
      else stock.delete(number);
    }
    const { empty } = this.state.kitchen;
    const base = empty ? new Set<number>() : this.plain.stock;
    const texts = (all: Iterable<number>): string[] => [...all].map((number) => this.world.text(number));
    this.set({
      kitchen: {
        empty,
        add: texts([...stock].filter((number) => !base.has(number))),
        remove: texts([...base].filter((number) => !stock.has(number))),
      },
      tree: 0,
    });
  }

  setKitchen(kitchen: KitchenChange): void {
    this.set({ kitchen, tree: 0 });
  }

  get kitchenChanged(): boolean {
    return JSON.stringify(this.state.kitchen) !== JSON.stringify(AS_IT_IS);
  }

  private seeKitchen(): void {
    const { empty, add, remove } = this.state.kitchen;
    const numbers = (texts: readonly string[]): number[] => texts.map((text) => this.plain.named(text)).filter((each) => each !== undefined);
    const gone = new Set(numbers(remove));
    const stock = [...(empty ? [] : this.plain.stock)].filter((number) => !gone.has(number));
    this.world = this.kitchenChanged ? this.plain.withStock([...stock, ...numbers(add)]) : this.plain;
  }

  /** The numbers of the goals that there are. */
  get goals(): number[] {
    return this.state.goals.map((text) => this.world.named(text)).filter((each) => each !== undefined);
  }

  query(change: Partial<Query> = {}): Query {
    const { method, by, founded, constraints, count } = this.state;
    return { goals: this.goals, method, by, founded, constraints, count, ...change };
  }

  /** What the answer depends on. */
  private get question(): string {
    const { view: _, tree: __, ...rest } = this.state;
    return JSON.stringify([rest, this.plain.row.title]);
  }

  /** Ask what the state asks, unless that was asked already. */
  private async ask(): Promise<void> {
    const question = this.question;
    if (question === this.asked) return;
    this.asked = question;
    this.solver.stop();
    this.kept.clear();
    this.answer = undefined;
    this.trouble = "";
    const unknown = this.state.goals.filter((text) => this.world.named(text) === undefined);
    if (unknown.length > 0) this.trouble = `This FOON has no ${unknown.join("; ")}.`;
    if (this.goals.length === 0 || unknown.length > 0) {
      this.running = undefined;
      this.showAnswer();
      return;
    }
    const running: Running = { since: performance.now(), progress: { better: null, bound: null } };
    this.running = running;
    this.showAnswer();
    this.tick();
    try {
      const answer = await this.retriever.retrieve(this.world, this.query(), (progress) => (running.progress = progress));
      if (this.running !== running) return;
      this.answer = answer;
      this.say(spoken(answer));
    } catch (error) {
      if (this.running !== running) return;
      this.trouble = error instanceof QueryError ? error.message : `Something went wrong, please report it: ${(error as Error).message}`;
    }
    this.running = undefined;
    this.showAnswer();
  }

  /** Ask the same once more. */
  again(): void {
    this.asked = "";
    void this.ask();
  }

  /** Say how long it has taken so far; the button to stop it stays the same one, to be pressed. */
  private tick(): void {
    clearInterval(this.ticking);
    this.ticking = setInterval(() => {
      if (this.running === undefined) clearInterval(this.ticking);
      else if (!tellProgress(this)) this.showAnswer();
    }, 250);
  }

  /** Show what was answered, where that is looked at: what is typed elsewhere is left alone. */
  private showAnswer(): void {
    if (this.state.view === "kitchen") this.main.setAttribute("aria-busy", this.running === undefined ? "false" : "true");
    else this.renderMain();
  }

  /** Open a FOON of one's own. */
  async open(file: File): Promise<void> {
    try {
      const { world, left } = withFoon(this.data.world, await file.text(), file.name);
      this.see(world);
      this.notice = `${file.name}: ${counted(world.units.length, "unit")}.${left > 0 ? ` ${counted(left, "unit")} could not be read.` : ""} The kitchen is as before.`;
    } catch (error) {
      if (!(error instanceof FileError)) throw error;
      this.notice = error.message;
    }
    this.say(this.notice);
    this.render();
  }

  /** Go back to the FOON that the page came with. */
  goBack(): void {
    this.see(this.data.world);
    this.notice = "";
    this.render();
  }

  get opened(): boolean {
    return this.plain.row !== this.data.world;
  }

  private see(row: PageData["world"]): void {
    this.plain = World.of(row);
    this.index = new Index(this.plain);
    this.world = this.plain;
    this.set({ ...START, view: "steps", constraints: FREE });
  }

  say(text: string): void {
    this.live.textContent = text;
  }

  render(): void {
    document.title = this.state.goals.length > 0 ? `${this.state.goals[0]!.split(" [")[0]} – FOON explorer` : "FOON explorer";
    const first = this.state.goals.length === 0 && this.state.view !== "kitchen";
    this.columns.className = first ? "columns first" : "columns";
    refill(this.head, header(this));
    refill(this.side, askPanel(this));
    this.renderMain();
  }

  renderMain(): void {
    this.main.setAttribute("aria-busy", this.running === undefined ? "false" : "true");
    refill(this.main, mainView(this));
  }
}

function spoken(answer: Answer): string {
  if (answer.status === "unreachable") return "There is no task tree.";
  const [tree] = answer.trees;
  const steps = tree === undefined ? "No tree so far" : counted(tree.units.length, "step");
  return `${steps}, ${answer.status === "optimal" ? "proven optimal" : answer.status === "limit" ? "stopped, not proven" : "found"}.`;
}
