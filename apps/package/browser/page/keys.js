// Where a place in a TOML text is: the keys that lead to it, for completion from the schema of scenes.

/// End of the string that begins at `start`.
function endOfString(text, start) {
  const quote = text[start];
  const long = text.startsWith(quote.repeat(3), start);
  const mark = long ? quote.repeat(3) : quote;
  for (let k = start + mark.length; k < text.length; ++k) {
    if (text[k] === "\\" && quote === '"') ++k;
    else if (text.startsWith(mark, k)) return k + mark.length;
    else if (!long && text[k] === "\n") return k;
  }
  return text.length;
}

const namesOf = (key) => key.split(".").map((name) => name.trim().replace(/^["']|["']$/g, "")).filter((name) => name !== "");

/// @return {path: names of the table, key: the key whose value is written there, or null, isHeader, present: keys of the
/// innermost table, word: what is written so far, start: where the word starts}; null inside a string or a comment
function placeInToml(text, place) {
  let table = [];
  const open = [];
  let key = null, start = 0, isHeader = false, present = [];
  const restart = (k) => { start = k + 1; };
  for (let k = 0; k < place; ++k) {
    const letter = text[k];
    if (letter === "#") {
      k = text.indexOf("\n", k) - 1;
      if (k < 0 || k >= place - 1) return null;
    } else if (letter === '"' || letter === "'") {
      const end = endOfString(text, k);
      const isInside = end > place || (end === place && text[place - 1] !== letter);
      if (isInside) return key === null ? null : {...now(), word: text.slice(k, place), start: k};
      k = end - 1;
    } else if (letter === "\n" && open.length === 0) {
      if (isHeader) [table, present] = [namesOf(text.slice(start, k).replace(/[[\]]/g, "")), []];
      [key, isHeader] = [null, false];
      restart(k);
    } else if (letter === "[" && open.length === 0 && key === null) {
      isHeader = true;
    } else if (letter === "=" && key === null) {
      key = text.slice(start, k).trim();
      present.push(namesOf(key)[0]);
      restart(k);
    } else if (letter === "{" || letter === "[") {
      open.push({letter, key, present});
      if (letter === "{") [key, present] = [null, []];
      restart(k);
    } else if ((letter === "}" || letter === "]") && open.length > 0) {
      ({key, present} = open.pop());
    } else if (letter === ",") {
      if (open.at(-1)?.letter === "{") key = null;
      restart(k);
    }
  }
  function now() {
    const inner = open.filter((part) => part.letter === "{").flatMap((part) => namesOf(part.key ?? ""));
    return {path: [...table, ...inner], key, isHeader, present};
  }
  const names = /[\w.-]*$/.exec(text.slice(start, place))[0].split(".");
  const word = names.pop(), found = now();
  if (key === null && !isHeader) found.path.push(...names);
  return {...found, word, start: place - word.length};
}

/// All forms that a value of a schema may have.
function formsOf(node) {
  if (!node) return [];
  return [node, ...(node.anyOf ?? []).flatMap(formsOf)];
}

/// Schemas of the value at a path; arrays count as their items.
function schemasAt(schema, path) {
  let nodes = formsOf(schema);
  for (const name of path) {
    nodes = withItems(nodes).flatMap((node) => {
      if (node.properties && name in node.properties) return formsOf(node.properties[name]);
      return typeof node.additionalProperties === "object" ? formsOf(node.additionalProperties) : [];
    });
  }
  return withItems(nodes);
}

function withItems(nodes) {
  return nodes.flatMap((node) => (node.items ? [node, ...withItems(formsOf(node.items))] : [node]));
}

/// Values that a schema names.
function valuesOf(nodes) {
  return nodes.flatMap((node) => {
    if (node.enum) return node.enum;
    if ("const" in node) return [node.const];
    return node.type === "boolean" ? [true, false] : [];
  });
}

/// What may be written at a place. @return list of {text, note}, those first that begin with the word
function completionsAt(schema, place) {
  if (place === null) return [];
  const found = new Map();
  const add = (text, note = "") => { if (!found.has(text)) found.set(text, note); };
  if (place.isHeader) {
    for (const [name, node] of Object.entries(schema.properties)) {
      if (node.type === "array") add(`[[${name}]]`);
      else if (node.type === "object") add(`[${name}]`);
    }
  } else if (place.key === null) {
    for (const node of schemasAt(schema, place.path)) {
      for (const [name, inner] of Object.entries(node.properties ?? {}))
        if (!place.present.includes(name)) add(name, inner.description);
    }
  } else {
    const nodes = schemasAt(schema, [...place.path, ...namesOf(place.key)]);
    for (const value of valuesOf(nodes)) add(JSON.stringify(value));
  }
  const bare = (text) => text.replace(/^["[]+/, "");
  const word = bare(place.word);
  return [...found].map(([text, note]) => ({text, note})).filter(({text}) => bare(text).startsWith(word));
}
