/** How values cross the desk: consecutive doubles (native/desk.h). A codec puts a value there and takes it back. */

/** Takes doubles from the desk, in order. */
export class Taker {
  private at = 0;
  constructor(private readonly desk: Float64Array) {}
  next(): number {
    return this.desk[this.at++] ?? NaN;
  }
  numbers(count: number): Float64Array {
    this.at += count;
    return this.desk.slice(this.at - count, this.at);
  }
}

/** `In` is what a caller may give (fields may be left out), `Out` what it gets. */
export interface Codec<In, Out> {
  put(to: number[], value: In | undefined): void;
  take(from: Taker): Out;
}

export const number = (otherwise = 0): Codec<number, number> => ({
  put: (to, value) => void to.push(value ?? otherwise),
  take: (from) => from.next(),
});
export const flag = (otherwise = false): Codec<boolean, boolean> => ({
  put: (to, value) => void to.push((value ?? otherwise) ? 1 : 0),
  take: (from) => from.next() !== 0,
});

/** N numbers. A missing one becomes NaN, which every call refuses. */
const numbers = <T extends number[]>(...otherwise: T): Codec<T, T> => ({
  put(to, value) {
    for (let i = 0; i < otherwise.length; ++i) to.push(value === undefined ? otherwise[i]! : Number(value[i]));
  },
  take: (from) => otherwise.map(() => from.next()) as T,
});
export const vec3 = (x = 0, y = 0, z = 0) => numbers<[x: number, y: number, z: number]>(x, y, z);
export const quat = () => numbers<[x: number, y: number, z: number, w: number]>(0, 0, 0, 1);

/** An enumeration: its names, and the value of each. */
export function choice<Name extends string>(values: Record<Name, number>, otherwise: NoInfer<Name>): Codec<Name, Name> {
  const names = new Map<number, Name>(Object.keys(values).map((name) => [values[name as Name], name as Name]));
  return {
    put: (to, value) => void to.push(values[value ?? otherwise] ?? NaN),
    take: (from) => names.get(from.next()) ?? otherwise,
  };
}

/** An object: its fields in the order of the desk. */
export function record<In, Out>(fields: { [K in keyof Out]: Codec<any, Out[K]> }): Codec<In, Out> {
  const names = Object.keys(fields) as (keyof Out)[];
  return {
    put(to, value) {
      for (const name of names) fields[name].put(to, (value as Partial<Out> | undefined)?.[name]);
    },
    take(from) {
      const out = {} as Out;
      for (const name of names) out[name] = fields[name].take(from);
      return out;
    },
  };
}

/** Takes a count, and so many elements. */
export function takeList<Out>(from: Taker, codec: Codec<any, Out>, count = from.next()): Out[] {
  const list: Out[] = [];
  for (let i = 0; i < count; ++i) list.push(codec.take(from));
  return list;
}
