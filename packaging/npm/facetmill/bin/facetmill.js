#!/usr/bin/env node
// Runs the program of the package for this system, with the same arguments, streams and exit code.
const { spawn } = require('node:child_process');
const { constants } = require('node:os');
const { executable, unstarted } = require('../index.cjs');

let program;
try {
  program = executable();
} catch (error) {
  console.error(error.message);
  process.exit(70);
}
const child = spawn(program, process.argv.slice(2), { stdio: 'inherit' });
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => child.kill(signal));
child.on('error', (error) => {
  console.error(unstarted(error).message);
  process.exit(70);
});
child.on('exit', (code, signal) => process.exit(signal ? 128 + constants.signals[signal] : code));
