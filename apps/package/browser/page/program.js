// The program: unpacked once, called in workers.

const program = {module: null, address: null};

async function unpacked(digits) {
  const bytes = Uint8Array.from(atob(digits), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function loadProgram() {
  const element = document.getElementById("program");
  program.module = await WebAssembly.compile(await unpacked(element.textContent));
  element.remove();
  const source = ["glue", "worker"].map((id) => document.getElementById(id).textContent);
  program.address = URL.createObjectURL(new Blob([source.join("\n")], {type: "text/javascript"}));
}

/// A call of the program that can be ended. told: {line(text, isError), kept(files)}, both optional
/// @return {done: promise of {status, output, files, failure}; null: ended, end()}
function callProgram({words, files, folder = "", keep = false}, told = {}) {
  const worker = new Worker(program.address);
  let settle;
  const done = new Promise((resolve) => { settle = resolve; });
  const end = (result) => {
    worker.terminate();
    settle(result);
  };
  worker.onmessage = ({data}) => {
    if ("line" in data) told.line?.(data.line, data.isError);
    else if ("kept" in data) told.kept?.(data.kept);
    else end(data);
  };
  worker.onerror = (event) => end({status: 1, output: "", files: {}, failure: event.message});
  worker.postMessage({module: program.module, words, files, folder, keep});
  return {done, end: () => end(null)};
}
