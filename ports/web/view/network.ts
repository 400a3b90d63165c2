/** A network without machines: messages are late, overtake each other, or never arrive, as a seed decides. */

/** Numbers in [0, 1) that a seed decides (xorshift32, Marsaglia 2003). */
export function seeded(seed: number): () => number {
  let state = Math.imul(seed + 1, 0x9e3779b1) >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}

/** Times in ms; `loss` is a share. */
export interface Conditions {
  delay: number;
  jitter: number;
  loss: number;
}

/** One direction of a connection. */
export class Link<Message> {
  private underway: { due: number; message: Message }[] = [];
  constructor(private readonly random: () => number) {}

  send(now: number, message: Message, { delay, jitter, loss }: Conditions): void {
    const [lot, late] = [this.random(), this.random()];
    if (lot >= loss) this.underway.push({ due: now + delay + late * jitter, message });
  }
  receive(now: number): Message[] {
    const arrived = this.underway.filter(({ due }) => due <= now).sort((a, b) => a.due - b.due);
    this.underway = this.underway.filter(({ due }) => due > now);
    return arrived.map(({ message }) => message);
  }
}
