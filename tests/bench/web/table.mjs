/** The rows as a table in Markdown: of each scene the engines' times, their ratios, and their errors. */
const short = (value) =>
  value === 0 ? '0' : value < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(3)));
const us = (value) => (value < 100 ? String(Number(value.toPrecision(3))) : Math.round(value).toLocaleString('en'));

export function table(rows) {
  const lines = [['scene', 'engine', 'us: median, p99, worst', 'over `fx64`', 'errors']];
  for (const row of rows) {
    const own = rows.find(({ scene, engine }) => scene === row.scene && engine === 'fx64');
    const errors = Object.entries(row.errors).map(([name, value]) => `${name} ${short(value)}`);
    lines.push([
      row.scene,
      row.engine,
      [row.us_median, row.us_p99, row.us_max].map(us).join(', '),
      own ? (row.us_median / own.us_median).toFixed(2) : '-',
      errors.join(', '),
    ]);
  }
  const shown = lines.map((line) => `| ${line.join(' | ')} |`);
  return [shown[0], `|${'---|'.repeat(lines[0].length)}`, ...shown.slice(1)].join('\n');
}
