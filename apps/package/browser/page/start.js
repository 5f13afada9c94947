// Last part: scenes to choose from, checks while the scene is written, runs, results.

const page = {name: "scene.toml", files: {}, run: null, check: null, results: null, wanted: 0, viewAddress: null};
const CHECK_AFTER_MILLISECONDS = 400;

const sceneFiles = () => ({...page.files, [page.name]: element("text").value});
const folderName = () => page.name.replace(/\.toml$/, "") + ".out";

function setState(text) {
  element("state").textContent = text;
}

function addLine(text) {
  const log = element("log");
  log.append(`${text}\n`);
  log.scrollTop = log.scrollHeight;
}

/// Checks the scene some time after its last change; a check of an older text is ended.
function checkLater() {
  clearTimeout(page.wanted);
  page.check?.end();
  if (!program.module || page.run) return;
  page.wanted = setTimeout(check, CHECK_AFTER_MILLISECONDS);
}

async function check() {
  page.check = callProgram({words: ["check", page.name, "--json"], files: sceneFiles()});
  const found = await page.check.done;
  if (found === null) return;
  page.check = null;
  try {
    const report = JSON.parse(found.output);
    showFaults(report.faults ?? [], page.name);
    if (!page.run) setState(report.good ? "the scene is good" : "the scene has faults");
  } catch (error) {
    setState(found.failure ?? "the scene cannot be checked");
  }
}

async function run() {
  clearTimeout(page.wanted);
  page.check?.end();
  element("log").textContent = "";
  showResults(null);
  const folder = folderName(), start = performance.now(), kept = {};
  const clock = setInterval(() => setState(`${Math.round((performance.now() - start) / 1000)} s`), 500);
  page.run = callProgram({words: ["run", page.name, "--view", "--out", folder], files: sceneFiles(), folder, keep: true},
    {line: addLine, kept: (files) => Object.assign(kept, files)});
  element("run").hidden = true;
  element("stop").hidden = false;
  const done = await page.run.done;
  page.run = null;
  clearInterval(clock);
  element("run").hidden = false;
  element("stop").hidden = true;
  const seconds = ((performance.now() - start) / 1000).toFixed(1);
  if (done === null) return showStopped(kept, folder, seconds);
  if (done.output) addLine(done.output);
  if (done.failure) addLine(done.failure);
  setState(done.status === 0 ? `done in ${seconds} s` : `failed after ${seconds} s`);
  showResults(done.files, folder);
}

/// Results of a run that was ended: what it had written until then, as a page made afterwards.
async function showStopped(kept, folder, seconds) {
  setState(`stopped after ${seconds} s`);
  if (!(`${folder}/blocks.pvd` in kept)) return;
  const made = await callProgram({words: ["view", folder], files: {...sceneFiles(), ...kept}, folder}, {line: addLine}).done;
  showResults(made?.status === 0 ? made.files : kept, folder);
}

/// files: {name: bytes}; null: none
function showResults(files, folder) {
  const view = files?.[`${folder}/view.html`];
  if (page.viewAddress) URL.revokeObjectURL(page.viewAddress);
  page.viewAddress = view ? URL.createObjectURL(new Blob([view], {type: "text/html"})) : null;
  page.results = files && Object.keys(files).length > 0 ? files : null;
  element("save-results").disabled = !page.results;
  element("whole").disabled = !view;
  element("view").hidden = !view;
  element("results").classList.toggle("shown", Boolean(view));
  element("view").src = page.viewAddress ?? "about:blank";
  element("log").scrollTop = element("log").scrollHeight;
}

function chooseScene(name) {
  const scene = scenes.find((each) => each.name === name);
  if (!scene) return false;
  element("examples").value = name;
  page.name = name.split("/").at(-1);
  page.files = {...scene.files};
  showFiles();
  setText(scene.text);
  return true;
}

function showFiles() {
  const names = Object.keys(page.files);
  element("files").hidden = names.length === 0;
  element("files").textContent = `beside the scene: ${names.join(", ")}`;
}

/// A scene goes into the editor; other files are beside it.
async function openFiles(list) {
  for (const file of list) {
    if (!file.name.endsWith(".toml")) {
      page.files[file.name] = new Uint8Array(await file.arrayBuffer());
      continue;
    }
    page.name = file.name;
    element("examples").value = "";
    setText(await file.text());
  }
  showFiles();
  checkLater();
}

/// The part of the address behind #: scene=NAME, and run to start it.
function followAddress() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const isChosen = wanted.has("scene") && chooseScene(wanted.get("scene"));
  if (wanted.has("scene") && !isChosen) addLine(`there is no scene ${wanted.get("scene")}`);
  if (isChosen && wanted.has("run") && program.module) run();
}

const scenes = JSON.parse(element("scenes").textContent);

function fillExamples() {
  element("examples").append(new Option("own scene", "", false, false));
  for (const group of [...new Set(scenes.map((scene) => scene.group))]) {
    const part = Object.assign(document.createElement("optgroup"), {label: group});
    for (const scene of scenes) if (scene.group === group) part.append(new Option(scene.title, scene.name));
    element("examples").append(part);
  }
}

async function start() {
  fillExamples();
  startEditor();
  editor.onChange = checkLater;
  chooseScene("tunnel_roof.toml");
  element("examples").onchange = () => chooseScene(element("examples").value);
  element("run").onclick = run;
  element("stop").onclick = () => page.run?.end();
  element("open").onchange = () => openFiles(element("open").files);
  element("save-scene").onclick = () => download(page.name, new Blob([element("text").value], {type: "text/plain"}));
  element("save-results").onclick = async () => download(`${folderName()}.zip`, await zipOf(page.results));
  element("whole").onclick = () => window.open(page.viewAddress, "_blank");
  try {
    await loadProgram();
  } catch (error) {
    setState(`this browser cannot run the program: ${error.message}`);
    return;
  }
  element("run").disabled = false;
  setState("ready");
  addEventListener("hashchange", followAddress);
  followAddress();
  checkLater();
  const schema = await callProgram({words: ["schema"], files: {}}).done;
  if (schema?.status === 0) editor.schema = JSON.parse(schema.output);
}

start();
