/** Finds objects by what people type, misspelt or cut short. */

import type { World } from "./foon/world";

export interface Hit {
  readonly number: number;
  readonly score: number;
}

const WORD = /[\p{L}\p{N}]+/gu;

export const wordsOf = (text: string): string[] => text.toLowerCase().match(WORD) ?? [];

/** The objects of a world by the words that they are written with. */
export class Index {
  private readonly byWord = new Map<string, Set<number>>();
  private readonly inLabel = new Map<number, Set<string>>();

  constructor(private readonly world: World) {
    world.nodes.forEach((node, number) => {
      this.inLabel.set(number, new Set(wordsOf(node.label)));
      for (const word of wordsOf(world.text(number))) {
        if (!this.byWord.has(word)) this.byWord.set(word, new Set());
        this.byWord.get(word)!.add(number);
      }
    });
  }

  /** The objects that fit best; `prefer` says how much more one is worth beside others that fit as well. */
  find(text: string, most: number, prefer: (number: number) => number = () => 0): Hit[] {
    const asked = wordsOf(text);
    if (asked.length === 0) return [];
    const scores = new Map<number, number>();
    for (const word of asked) {
      const best = new Map<number, number>();
      for (const [known, numbers] of this.byWord) {
        const likeness = alike(word, known);
        if (likeness === 0) continue;
        for (const number of numbers) {
          const score = likeness * (this.inLabel.get(number)!.has(known) ? 1 : 0.45);
          if (score > (best.get(number) ?? 0)) best.set(number, score);
        }
      }
      for (const [number, score] of best) scores.set(number, (scores.get(number) ?? 0) + score);
    }
    const most_ = Math.max(0, ...scores.values());
    return [...scores]
      .filter(([, score]) => score >= 0.6 * most_)
      .map(([number, score]) => ({ number, score: score + prefer(number) - 0.12 * Math.max(0, this.inLabel.get(number)!.size - asked.length) }))
      .sort((one, other) => other.score - one.score || this.world.text(one.number).length - this.world.text(other.number).length || one.number - other.number)
      .slice(0, most);
  }
}

/** Labels of a list that fit best. */
export function findTexts(texts: readonly string[], asked: string, most: number): string[] {
  const words = wordsOf(asked);
  if (words.length === 0) return texts.slice(0, most);
  const score = (text: string): number => {
    const known = wordsOf(text);
    const each = words.map((word) => Math.max(0, ...known.map((other) => alike(word, other))));
    return each.includes(0) ? 0 : each.reduce((sum, one) => sum + one, 0) - 0.05 * known.length;
  };
  return texts
    .map((text) => ({ text, score: score(text) }))
    .filter((each) => each.score > 0)
    .sort((one, other) => other.score - one.score || (one.text < other.text ? -1 : 1))
    .slice(0, most)
    .map((each) => each.text);
}

/** How much a word that was typed is like a known one, from 0 to 1. */
export function alike(typed: string, known: string): number {
  if (typed === known) return 1;
  if (known.startsWith(typed)) return 0.9 - 0.02 * Math.min(10, known.length - typed.length);
  if (typed.length >= 3 && known.includes(typed)) return 0.6;
  const allowed = typed.length < 4 ? 0 : typed.length < 7 ? 1 : 2;
  if (allowed === 0) return 0;
  // What is typed may be misspelt and cut short at once.
  const whole = distance(typed, known, allowed);
  const begun = known.length > typed.length ? distance(typed, known.slice(0, typed.length), allowed) + 0.5 : Infinity;
  const errors = Math.min(whole, begun);
  return errors > allowed ? 0 : 0.8 - 0.2 * errors;
}

/** The number of signs to insert, leave out, replace or exchange with their neighbour; Infinity if above `most`. */
function distance(one: string, other: string, most: number): number {
  if (Math.abs(one.length - other.length) > most) return Infinity;
  let before: number[] = [];
  let row = Array.from({ length: other.length + 1 }, (_, place) => place);
  for (let i = 1; i <= one.length; i += 1) {
    const next = [i];
    for (let j = 1; j <= other.length; j += 1) {
      const same = one[i - 1] === other[j - 1] ? 0 : 1;
      let cost = Math.min(row[j]! + 1, next[j - 1]! + 1, row[j - 1]! + same);
      if (i > 1 && j > 1 && one[i - 1] === other[j - 2] && one[i - 2] === other[j - 1]) cost = Math.min(cost, before[j - 2]! + 1);
      next.push(cost);
    }
    [before, row] = [row, next];
  }
  const found = row[other.length]!;
  return found > most ? Infinity : found;
}
