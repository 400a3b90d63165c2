/** Recordings in node: equal to native ones, searched, and refused where they are damaged. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { configs, crc32, load, recording, recordings, sceneAssets } from './support.mjs';

/** The recording with another byte in one of its chunks, under a right checksum; and the tick of that chunk. */
function withWrongByte(intact, random) {
  const bytes = intact.slice();
  const view = new DataView(bytes.buffer);
  const chunks = [];
  for (let at = 72; at < bytes.length; at += 20 + view.getUint16(at + 2, true)) chunks.push(at);
  const at = chunks[random % chunks.length];
  const end = at + 16 + view.getUint16(at + 2, true);
  bytes[at + 16 + (random % (end - at - 16))] ^= 1 << (random >>> 29);
  view.setUint32(end, crc32(bytes.subarray(at, end)), true);
  return { bytes, tick: Number(view.getBigUint64(at + 8, true)) };
}

for (const config of configs) {
  const detent = await load(config);
  const open = (bytes) => {
    const replay = detent.openRecording(bytes);
    if (replay.problem() === undefined) replay.start(sceneAssets);
    return replay;
  };

  for (const { scene, ticks, digest } of recordings.filter((each) => each.config === config)) {
    test(`every tick of ${scene} has the recorded digest in ${config}`, () => {
      const replay = open(recording(scene, config));
      assert.equal(replay.verify(), ticks);
      assert.equal(replay.digest(), digest);
      replay.close();
    });
  }

  test(`a replay in ${config} goes to any tick, by keyframes, snapshots and from the seed`, () => {
    const replay = open(recording('terrain', config));
    const digests = [replay.digest()];
    const snapshots = [replay.save()];
    for (let tick = 1; tick <= 60; ++tick) {
      assert.equal(replay.step().tick, tick);
      digests.push(replay.digest());
      snapshots.push(replay.save());
    }
    for (const tick of [60, 17, 0, 31, 30, 59]) {
      replay.seek(tick);
      assert.equal(replay.digest(), digests[tick]);
      replay.resume(snapshots[60 - tick]);
      assert.equal(replay.digest(), digests[60 - tick]);
      if (tick > 0) assert.equal((replay.step(), replay.digest()), digests[60 - tick + 1]);
    }
    assert.throws(() => replay.seek(1e6), { status: 'out_of_range' });
    replay.close();
  });

  test(`a flipped bit in ${config} is refused where it lies, and the ticks before it agree`, () => {
    const intact = recording('stack', config);
    for (let at = 0; at < intact.length; at += 97) {
      const damaged = intact.slice();
      damaged[at] ^= 1 << (at % 8);
      const replay = detent.openRecording(damaged);
      let ticks = 0;
      assert.throws(() => {
        replay.start(sceneAssets);
        for (; ; ++ticks) if (replay.step().finished) return;
      });
      const problem = replay.problem();
      assert.notEqual(problem, undefined);
      assert.ok(problem.tick >= ticks && problem.tick <= ticks + 1, `${problem.text} after ${ticks} ticks`);
      replay.close();
    }
  });

  test(`bytes that are wrong under right checksums are refused in ${config}, and never trap`, () => {
    for (const scene of ['changes', 'jointed', 'terrain']) {
      const intact = recording(scene, config);
      for (let i = 0; i < 60; ++i) {
        const { bytes, tick } = withWrongByte(intact, (i * 2654435761) >>> 0);
        const replay = detent.openRecording(bytes);
        try {
          replay.start(sceneAssets);
          for (let ticks = 0; ticks < tick + 3 && !replay.step().finished; ++ticks);
        } catch (error) {
          assert.equal(error.name, 'DetentError', `${scene} ${i}: ${error}`);
        }
        replay.close();
      }
    }
  });

  test(`a recording in ${config} that is cut anywhere is refused`, () => {
    const whole = recording('tiny', config);
    for (let count = 0; count < whole.length; count += 61) {
      const replay = detent.openRecording(whole.slice(0, count));
      assert.throws(() => {
        replay.start(sceneAssets);
        replay.verify();
      });
      replay.close();
    }
  });
}

test('a recording of another configuration is refused by name', async () => {
  const replay = (await load('fx64')).openRecording(recording('stack', 'f32'));
  assert.equal(replay.problem().status, 'config_differs');
  assert.equal(replay.header.config, 'f32');
  assert.throws(() => replay.start(), { status: 'config_differs' });
  replay.close();
});

test('a recording without its assets is refused', async () => {
  const replay = (await load('fx64')).openRecording(recording('terrain', 'fx64'));
  assert.throws(() => replay.start([]), { status: 'asset_missing' });
  replay.close();
});
