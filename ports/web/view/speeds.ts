/** The list of speeds. */
import { element } from './elements.js';

const speeds = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8];

export interface Speeds {
  /** Times that of the world's clock. */
  readonly speed: number;
  /** To the next slower or faster one. */
  change(by: number): void;
}

export function bindSpeeds(): Speeds {
  const list = element<HTMLSelectElement>('speed');
  list.replaceChildren(
    ...speeds.map((each) => new Option(each < 1 ? `1/${1 / each} ×` : `${each} ×`, String(each), each === 1, each === 1)),
  );
  return {
    get speed() {
      return Number(list.value);
    },
    change(by) {
      list.selectedIndex = Math.min(speeds.length - 1, Math.max(0, list.selectedIndex + by));
    },
  };
}
