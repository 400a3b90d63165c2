/** Browsers that are started without a driver, with an empty profile, to open one page. */
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, flags } from './browser.mjs';

const firefox = process.env.FIREFOX ?? '/usr/bin/firefox-esr';

/** No first page, no updates, no reports, no requests of its own. */
const preferences = {
  'app.normandy.enabled': false,
  'app.update.enabled': false,
  'browser.aboutwelcome.enabled': false,
  'browser.newtabpage.activity-stream.feeds.topsites': false,
  'browser.safebrowsing.downloads.remote.enabled': false,
  'browser.safebrowsing.malware.enabled': false,
  'browser.safebrowsing.phishing.enabled': false,
  'browser.shell.checkDefaultBrowser': false,
  'browser.startup.homepage_override.mstone': 'ignore',
  'browser.startup.page': 0,
  'datareporting.healthreport.uploadEnabled': false,
  'datareporting.policy.dataSubmissionEnabled': false,
  'extensions.update.enabled': false,
  'network.captive-portal-service.enabled': false,
  'network.connectivity-service.enabled': false,
  'network.proxy.type': 0,
  'services.settings.server': 'data:,',
  'toolkit.telemetry.reportingpolicy.firstRun': false,
};

/** By name: the reason why a browser cannot run, or false; and the command that opens an address. */
export const browsers = {
  Firefox: {
    missing: !existsSync(firefox) && 'firefox-esr is not installed',
    command(folder, address) {
      const lines = Object.entries(preferences).map(
        ([key, value]) => `user_pref("${key}", ${JSON.stringify(value)});\n`,
      );
      writeFileSync(join(folder, 'user.js'), lines.join(''));
      return [firefox, '--headless', '--no-remote', '--profile', folder, address];
    },
  },
  Chromium: {
    missing: !existsSync(chromium) && 'chromium is not installed',
    command: (folder, address) => [chromium, ...flags, `--user-data-dir=${folder}`, address],
  },
};

/** Opens an address, waits for a result, and ends the browser. Fails if there is none after two minutes. */
export async function withBrowser({ command }, address, result) {
  const folder = mkdtempSync(join(tmpdir(), 'detent-browser-'));
  const profile = join(folder, 'profile');
  mkdirSync(profile);
  const [program, ...options] = command(profile, address);
  // A process group of its own: the browser starts others, which end with it.
  const browser = spawn(program, options, {
    detached: true,
    stdio: ['ignore', 'ignore', 'pipe'],
    env: { ...process.env, HOME: folder, MOZ_CRASHREPORTER_DISABLE: '1' },
  });
  const kill = () => {
    try {
      process.kill(-browser.pid, 'SIGKILL');
    } catch {} // it has ended
  };
  const stop = () => process.exit(1); // calls kill()
  process.once('exit', kill).once('SIGTERM', stop).once('SIGINT', stop);
  let said = '';
  browser.stderr.on('data', (text) => (said = (said + text).slice(-2000)));
  const ended = new Promise((resolve) => browser.once('exit', resolve).once('error', resolve));
  let timer;
  const late = new Promise((resolve) => (timer = setTimeout(resolve, 120000)));
  const fail = (what) => {
    throw new Error(`${program} ${what}. It said: ${said}`);
  };
  try {
    return await Promise.race([result, ended.then(() => fail('has ended')), late.then(() => fail('has no result'))]);
  } finally {
    clearTimeout(timer);
    kill();
    await ended;
    process.off('exit', kill).off('SIGTERM', stop).off('SIGINT', stop);
    // Children of the browser may still write for a moment.
    rmSync(folder, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
  }
}
