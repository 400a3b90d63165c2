/** Numbers as the page shows them. */

export const digits = (value: number): string => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
};

/** A component that is a millionth of the largest is shown as 0. */
export const vector = (v: readonly number[]): string => {
  const largest = Math.max(...v.map(Math.abs));
  return v.map((x) => digits(Math.abs(x) < 1e-6 * largest ? 0 : x)).join(', ');
};
/** A position, m, to a tenth of a millimetre: four digits would not do far from the origin. */
export const place = (v: readonly number[]): string => v.map((x) => String(Number(x.toFixed(4)))).join(', ');
