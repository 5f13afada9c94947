// The program for browsers in node, on the files of this system: node program_in_node.js ASHLAR.js WORD...
// Files are those below the present folder; the exit status is the program's.
"use strict";
const fs = require("fs");
const path = require("path");

async function main([script, ...words]) {
  const make = require(path.resolve(script));
  const folder = process.cwd();
  const program = await make({
    wasmBinary: fs.readFileSync(path.resolve(script).replace(/\.js$/, ".wasm")),
    print: (line) => fs.writeSync(1, `${line}\n`),
    printErr: (line) => fs.writeSync(2, `${line}\n`),
  });
  program.FS.mkdir("/here");
  program.FS.mount(program.NODEFS ?? program.FS.filesystems.NODEFS, {root: folder}, "/here");
  program.FS.chdir("/here");
  return program.callMain(words);
}

main(process.argv.slice(2)).then((status) => {
  process.exitCode = status;
});
