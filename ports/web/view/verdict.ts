/** The sentences that the page says of its recording. */
import type { RecordingInfo, ReplayProblem } from '../src/index.js';
import type { Playback } from './playback.js';

export interface Verdict {
  kind: 'busy' | 'good' | 'bad';
  text: string;
  detail: string;
}

const hexadecimal = (digest: bigint) => digest.toString(16).padStart(16, '0');

export function verdictOf(playback: Playback, digest: () => bigint): Verdict {
  const { problem, first, last, verified, shown } = playback;
  if (problem !== undefined) return { kind: 'bad', ...problemText(problem) };
  if (!playback.finished) {
    return {
      kind: 'busy',
      text: `verifying: tick ${verified} of ${last}`,
      detail: 'Each tick is replayed, and its digest compared.',
    };
  }
  const interval = shown.header.digestInterval;
  const text =
    interval === 1
      ? 'every tick agrees'
      : interval === 0
        ? 'the final digest agrees'
        : `every digest agrees (one in ${interval} ticks)`;
  return {
    kind: 'good',
    text,
    detail:
      `${last - first} ticks were replayed in this page, and ${playback.compared} digests compared; all are equal to the recorded ones. ` +
      `Final digest: ${hexadecimal(digest())}.`,
  };
}

function problemText(problem: ReplayProblem): { text: string; detail: string } {
  if (problem.status === 'digest_differs') {
    const values =
      problem.digestRecorded === problem.digestReplayed
        ? problem.field
        : `recorded ${hexadecimal(problem.digestRecorded)}, here ${hexadecimal(problem.digestReplayed)}`;
    return { text: `tick ${problem.tick} differs`, detail: `${values}. Find the field with: detent diff` };
  }
  return { text: `damaged at tick ${problem.tick}`, detail: problem.text };
}

/** Why nothing of a recording can be shown. `it`: what the sentence calls it. */
export function refusal(
  problem: ReplayProblem,
  header: RecordingInfo | undefined,
  simulationVersion: number,
  it = 'This recording',
): string {
  switch (problem.status) {
    case 'simulation_differs':
      return (
        `${it} is of simulation version ${header?.simulationVersion ?? 'unknown'}, and this page replays version ` +
        `${simulationVersion}. Make the page with the detent tool of that version.`
      );
    case 'config_differs':
      return `${it} is of the configuration ${header?.config ?? 'unknown'}, which this page does not replay.`;
    case 'not_detent':
      return `${it} is not a recording of Detent.`;
    case 'format_unknown':
      return `${it} has format version ${header?.formatVersion ?? 'unknown'}, which this page does not read.`;
    case 'asset_missing':
    case 'asset_mismatch':
      return `${it} needs cooked files that this page does not have. Name them with: detent view --asset FILE`;
    case 'buffer_too_small':
      return 'There is not enough memory for the world of this recording.';
    default:
      return `${it} is damaged: ${problem.text}.`;
  }
}
