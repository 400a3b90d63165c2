/** The comparison of two recordings, which `detent diff` prints (native/compare.cpp). */
import type { Module } from '../src/module.js';

export interface Named {
  name: string;
  bytes: Uint8Array;
}
export interface Comparison {
  /** Why they cannot be compared is in `text`. */
  impossible: boolean;
  different: boolean;
  /** One of them is not whole: they were compared up to there. */
  damaged: boolean;
  afterLastTick: boolean;
  /** The ticks that both have, and the last one up to which they are equal. */
  first: number;
  last: number;
  equalTo: number;
  /** The tick that differs; if it is not the one after `equalTo`, the first one is between them. */
  tick: number;
  /** As `detent diff` prints it: one line and its details. */
  text: string;
  stage: string;
  /** What differs there, by slots. */
  bodies: number[];
  joints: number[];
}

export function compareRecordings(module: Module, a: Named, b: Named, assets: Uint8Array[]): Comparison {
  const name = (text: string) => new TextEncoder().encode(text);
  const stored = [name(a.name), a.bytes, name(b.name), b.bytes, ...assets].map((bytes) => module.store(bytes));
  const table = module.storeTable(stored);
  try {
    const marks = module.ask('compare_recordings', table, assets.length);
    const desk = module.desk();
    const flag = () => desk.next() !== 0;
    const text = () => module.textOf({ address: desk.next(), count: desk.next() });
    const comparison: Comparison = {
      impossible: flag(),
      different: flag(),
      damaged: flag(),
      afterLastTick: flag(),
      first: desk.next(),
      last: desk.next(),
      equalTo: desk.next(),
      tick: desk.next(),
      text: text(),
      stage: text(),
      bodies: [],
      joints: [],
    };
    for (let i = 0; i < marks; ++i) {
      const list = desk.next() === 1 ? comparison.bodies : comparison.joints;
      const slot = desk.next();
      if (!list.includes(slot)) list.push(slot);
    }
    return comparison;
  } finally {
    for (const place of stored) module.free(place.address);
    module.free(table);
  }
}
