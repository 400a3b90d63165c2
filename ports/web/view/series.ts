/** The step reports of all ticks, as the numbers that the graphs show. */
import type { StepReport } from '../src/index.js';

export interface SeriesDef {
  name: string;
  /** What the number counts, for a tooltip. */
  text: string;
  of: (report: StepReport) => number;
  lost?: boolean;
}

/** What a step lost, clamped or left undecided, by name. */
export function losses(report: StepReport): [name: string, count: number][] {
  const { lost, ccd, contacts, joints, events } = report;
  const all: [string, number][] = [
    ['pairs dropped', lost.pairs],
    ['contacts dropped', lost.contacts],
    ['joint couplings dropped', lost.jointCouplings],
    ['impacts dropped', lost.impacts],
    ['sensed bodies dropped', lost.sensed],
    ['sensor tests undecided', lost.sensedUndecided],
    ['values clamped', report.saturations],
    ['bodies stopped early', ccd.bodiesStopped],
    ['overlaps too deep', ccd.overlapsLeft],
    ['impacts undecided', ccd.undecided],
    ['contact searches capped', contacts.capped],
    ['joint solves undecided', joints.undecided],
  ];
  return all.filter(([, count]) => count !== 0);
}
const sum = (list: [string, number][]) => list.reduce((total, [, count]) => total + count, 0);

export const seriesDefs: SeriesDef[] = [
  { name: 'awake', text: 'dynamic bodies that took part in the step', of: (report) => report.awake },
  { name: 'islands', text: 'groups of awake bodies that contacts or joints connect', of: (report) => report.islands },
  { name: 'contacts', text: 'contacts of awake bodies', of: (report) => report.contacts.count },
  { name: 'substeps', text: 'the largest number of substeps of any island', of: (report) => report.substepsMax },
  { name: 'impacts', text: 'impacts of continuous collision within the tick', of: (report) => report.ccd.impacts },
  {
    name: 'lost',
    text: 'what the step dropped, clamped or left undecided',
    of: (report) => sum(losses(report)),
    lost: true,
  },
];

export class Series {
  /** By series, then by tick from the first one; the entry 0 stays 0: the seed has no step. */
  readonly values: Float32Array[];
  readonly max: number[] = seriesDefs.map(() => 0);

  constructor(readonly ticks: number) {
    this.values = seriesDefs.map(() => new Float32Array(ticks + 1));
  }
  note(index: number, report: StepReport): void {
    seriesDefs.forEach((def, i) => {
      const value = def.of(report);
      this.values[i]![index] = value;
      this.max[i] = Math.max(this.max[i]!, value);
    });
  }
  /** The largest value in a range of ticks. */
  peak(series: number, from: number, to: number): number {
    const values = this.values[series]!;
    let peak = 0;
    for (let i = Math.max(0, from); i <= to && i < values.length; ++i) peak = Math.max(peak, values[i]!);
    return peak;
  }
}
