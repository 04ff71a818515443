// The readers that package-lock.json names, fetched into the current folder.
import { spawnSync } from 'node:child_process';
import { copyFileSync, existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

// A require() that finds them. Ends the program with 77 where they cannot be had.
export function fetchPackages() {
  if (!existsSync(join('node_modules', '.package-lock.json'))) {
    for (const name of ['package.json', 'package-lock.json']) copyFileSync(join(here, name), name);
    const options = ['--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'];
    const installed = spawnSync('npm', ['ci', ...options], { encoding: 'utf8' });
    if (installed.status !== 0) {
      console.error(`the readers cannot be fetched: ${installed.stderr}`);
      process.exit(77);
    }
  }
  return createRequire(join(process.cwd(), 'package.json'));
}
