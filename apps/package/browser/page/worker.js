// Calls the program, in a worker: each call has an instance of its own, with files of its own.
// Asked: {module, words, files, folder, keep}. module: the compiled program; words: its command line; files: {name: text or
// bytes} to write before; folder: that of results, if any; keep: results are sent during the run too, so that a run that is
// ended keeps them.
// Told: {line, isError} for each line; {kept} files of results so far that have changed; at the end {status, output, files}.

const HOME = "/work";
const KEEP_MILLISECONDS = 2000;

/// Files of a folder and those below it, {name: bytes}, as far as they changed since. seen: {name: what is known of them}
function changedFiles(FS, folder, seen) {
  const found = {};
  const walk = (path) => {
    for (const name of FS.readdir(path)) {
      if (name === "." || name === "..") continue;
      const inside = `${path}/${name}`;
      const status = FS.stat(inside);
      if (FS.isDir(status.mode)) {
        walk(inside);
        continue;
      }
      const mark = `${status.size} ${Number(status.mtime)}`;
      if (seen[inside] === mark) continue;
      seen[inside] = mark;
      found[inside.slice(HOME.length + 1)] = FS.readFile(inside);
    }
  };
  if (FS.analyzePath(folder).exists) walk(folder);
  return found;
}

function writeFiles(FS, files) {
  FS.mkdir(HOME);
  FS.chdir(HOME);
  for (const [name, content] of Object.entries(files)) {
    const folders = name.split("/").slice(0, -1);
    folders.forEach((_, k) => {
      const path = `${HOME}/${folders.slice(0, k + 1).join("/")}`;
      if (!FS.analyzePath(path).exists) FS.mkdir(path);
    });
    FS.writeFile(`${HOME}/${name}`, content);
  }
}

async function call({module, words, files, folder, keep}) {
  const seen = {};
  const output = [];
  let FS = null;
  let keptAt = performance.now();
  const errors = (line) => {
    postMessage({line, isError: true});
    if (!keep || FS === null || performance.now() - keptAt < KEEP_MILLISECONDS) return;
    postMessage({kept: changedFiles(FS, `${HOME}/${folder}`, seen)});
    keptAt = performance.now();
  };
  const program = await ashlar({
    instantiateWasm: (imports, done) => {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance));
      return {};
    },
    print: (line) => output.push(line),
    printErr: errors,
  });
  FS = program.FS;
  writeFiles(FS, files);
  let status = 1;
  try {
    status = program.callMain(words);
  } catch (error) {
    const memory = error instanceof RangeError || /memory/i.test(String(error));
    errors(memory ? "out of memory: a browser gives a page at most 4 GB" : `the program has failed: ${error}`);
  }
  postMessage({status, output: output.join("\n"), files: folder ? changedFiles(FS, `${HOME}/${folder}`, {}) : {}});
}

onmessage = ({data}) => {
  call(data).catch((error) => postMessage({status: 1, output: "", files: {}, failure: String(error)}));
};
