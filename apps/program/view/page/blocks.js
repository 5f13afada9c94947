// The list of blocks: search by name or material, hide, isolate.

const MOST_LISTED = 200;

/// Numbers of the blocks whose name or material contains the search text.
function foundBlocks() {
  const text = element("search").value.trim().toLowerCase();
  return data.blocks.map((_, k) => k).filter((k) => !data.blocks[k].absent
    && (data.blocks[k].name + " " + data.blocks[k].material).toLowerCase().includes(text));
}

function showBlockList() {
  const found = foundBlocks();
  const entries = found.slice(0, MOST_LISTED).map((block) => {
    const entry = document.createElement("li");
    const eye = document.createElement("input");
    Object.assign(eye, {type: "checkbox", checked: !current.hidden.has(block), title: "shown"});
    eye.setAttribute("aria-label", "show " + data.blocks[block].name);
    eye.addEventListener("change", () => hide([block], !eye.checked));
    const name = document.createElement("button");
    name.textContent = data.blocks[block].name;
    name.className = current.picked.block === block ? "name picked" : "name";
    name.addEventListener("click", () => {
      current.picked = {block};
      showPicked();
    });
    entry.append(eye, name);
    return entry;
  });
  element("block-list").replaceChildren(...entries);
  const shown = data.blocks.filter((block, k) => !block.absent && !current.hidden.has(k)).length;
  const all = data.blocks.filter((block) => !block.absent).length;
  const more = found.length > MOST_LISTED ? ", the first " + MOST_LISTED + " listed" : "";
  element("block-count").textContent = found.length + " found" + more + "; " + shown + " of " + all + " shown";
}

function hide(blocks, hidden) {
  for (const block of blocks) {
    if (hidden) current.hidden.add(block);
    else current.hidden.delete(block);
  }
  updatePicked();
  showBlockList();
  show();
}

function isolate(blocks) {
  current.hidden = new Set(data.blocks.map((_, k) => k).filter((k) => !blocks.includes(k)));
  updatePicked();
  showBlockList();
  show();
}

function tieBlockList() {
  element("search").addEventListener("input", showBlockList);
  element("isolate").addEventListener("click", () => isolate(foundBlocks()));
  element("hide").addEventListener("click", () => hide(foundBlocks(), true));
  element("show-all").addEventListener("click", () => isolate(data.blocks.map((_, k) => k)));
  element("isolate-picked").addEventListener("click", () => isolate([current.picked.block]));
  element("hide-picked").addEventListener("click", () => hide([current.picked.block], true));
  element("relative-picked").addEventListener("click", () => showRelativeTo(current.picked.block));
  showBlockList();
}
