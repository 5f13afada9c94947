// The text of the scene: numbers of lines, faults at their lines, completion.

const editor = {schema: null, list: [], chosen: 0, place: null, onChange: () => {}};
const element = (id) => document.getElementById(id);

function showLineNumbers(faults = []) {
  const kinds = {};
  for (const {line, severity} of faults) if (kinds[line] !== "error") kinds[line] = severity;
  const count = element("text").value.split("\n").length;
  element("lines").replaceChildren(...Array.from({length: count}, (_, k) => {
    const number = document.createElement("div");
    number.textContent = k + 1;
    if (kinds[k + 1]) number.className = kinds[k + 1];
    return number;
  }));
  element("lines").scrollTop = element("text").scrollTop;
}

function showFaults(faults, name) {
  const own = faults.filter(({file}) => !file || file === name);
  showLineNumbers(own);
  element("faults").replaceChildren(...faults.map(({severity, file, line, column, message}) => {
    const item = document.createElement("li");
    item.className = severity;
    const place = [file === name ? "line" : file, line].filter(Boolean).join(" ");
    item.textContent = line ? `${place}: ${message}` : message;
    item.onclick = () => goTo(line, column);
    return item;
  }));
}

function goTo(line, column) {
  if (!line) return;
  const text = element("text");
  const before = text.value.split("\n").slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
  const place = before + Math.max(0, (column || 1) - 1);
  text.focus();
  text.setSelectionRange(place, place);
  text.scrollTop = Math.max(0, (line - 4) * lineHeight());
}

const lineHeight = () => Number.parseFloat(getComputedStyle(element("text")).lineHeight);

function setText(text) {
  element("text").value = text;
  element("text").scrollTop = 0;
  hideCompletions();
  showLineNumbers();
  editor.onChange();
}

function hideCompletions() {
  element("completions").hidden = true;
  editor.list = [];
}

/// isAsked: by its key; otherwise only where a word has begun.
function offerCompletions(isAsked) {
  const text = element("text");
  if (!editor.schema || text.selectionStart !== text.selectionEnd) return hideCompletions();
  editor.place = placeInToml(text.value, text.selectionStart);
  editor.list = isAsked || editor.place?.word ? completionsAt(editor.schema, editor.place) : [];
  if (editor.list.length === 0 || (editor.list.length === 1 && editor.list[0].text === editor.place.word)) return hideCompletions();
  editor.chosen = 0;
  showCompletions();
}

function showCompletions() {
  const text = element("text"), list = element("completions");
  const lines = text.value.slice(0, text.selectionStart).split("\n");
  const letterWidth = 7.85;
  list.replaceChildren(...editor.list.map(({text: words, note}, k) => {
    const item = document.createElement("li");
    item.textContent = words;
    if (note) item.append(Object.assign(document.createElement("span"), {textContent: note.slice(0, 80)}));
    item.className = k === editor.chosen ? "chosen" : "";
    item.onmousedown = (event) => {
      event.preventDefault();
      complete(k);
    };
    return item;
  }));
  list.hidden = false;
  const top = lines.length * lineHeight() - text.scrollTop + 6;
  const fits = top + list.offsetHeight < element("editor").clientHeight;
  list.style.top = `${fits ? top : Math.max(0, top - lineHeight() - list.offsetHeight - 4)}px`;
  const left = 50 + lines.at(-1).length * letterWidth - text.scrollLeft;
  list.style.left = `${Math.max(0, Math.min(left, element("editor").clientWidth - list.offsetWidth))}px`;
  list.children[editor.chosen].scrollIntoView({block: "nearest"});
}

function complete(index) {
  const text = element("text");
  const words = editor.list[index].text;
  let start = editor.place.start, end = text.selectionStart;
  // Brackets of a header and quotes that are there already are not doubled.
  while (words[0] === "[" && text.value[start - 1] === "[") --start;
  while (words.at(-1) === "]" && text.value[end] === "]") ++end;
  if (words.at(-1) === '"' && text.value[end] === '"') ++end;
  text.setRangeText(words, start, end, "end");
  hideCompletions();
  showLineNumbers();
  editor.onChange();
}

function onEditorKey(event) {
  if (event.key === " " && event.ctrlKey) {
    event.preventDefault();
    offerCompletions(true);
  } else if (editor.list.length > 0) {
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (step) editor.chosen = (editor.chosen + step + editor.list.length) % editor.list.length;
    if (step) showCompletions();
    else if (event.key === "Enter" || event.key === "Tab") complete(editor.chosen);
    else if (event.key === "Escape") hideCompletions();
    else return;
    event.preventDefault();
  }
}

function startEditor() {
  const text = element("text");
  text.addEventListener("input", () => {
    showLineNumbers();
    offerCompletions(false);
    editor.onChange();
  });
  text.addEventListener("scroll", () => {
    element("lines").scrollTop = text.scrollTop;
    hideCompletions();
  });
  text.addEventListener("keydown", onEditorKey);
  text.addEventListener("blur", hideCompletions);
}
