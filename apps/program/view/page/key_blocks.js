// The table of key blocks.

/// key_blocks.csv of the folder, if any: a row a block that can leave. A click picks the block.
function showKeyBlocks() {
  const rows = data.key_blocks || [];
  element("key-blocks").hidden = rows.length === 0;
  const table = element("key-block-table");
  const numbers = new Map(data.blocks.map(({name}, k) => [name, k]));
  const row = (cells, block) => {
    const line = document.createElement("tr");
    for (const text of cells) line.insertCell().textContent = text;
    if (block !== undefined) {
      line.className = "pickable";
      line.addEventListener("click", () => {
        current.picked = {block};
        showPicked();
      });
    }
    return line;
  };
  const factorText = (of) => of.factor_of_safety === null ? "no limit" : short(of.factor_of_safety);
  element("key-block-note").textContent = "Each by itself, as placed, by key-block theory (ashlar blocks).";
  table.replaceChildren(row(["block", "factor", "mode", "m³", "force"]),
    ...rows.map((of) => row([of.block, factorText(of), of.mode, short(of.volume),
      of.needed_force > 0 ? quantity(of.needed_force, "N") : "none"], numbers.get(of.block))));
}
