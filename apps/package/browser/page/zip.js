// A ZIP archive of results.

const crcTable = Uint32Array.from({length: 256}, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value;
});

function crcOf(bytes) {
  let value = ~0;
  for (const byte of bytes) value = crcTable[(value ^ byte) & 255] ^ (value >>> 8);
  return ~value >>> 0;
}

async function deflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Numbers of given widths in bytes, the least byte first.
function numbers(...pairs) {
  return Uint8Array.from(pairs.flatMap(([width, value]) => Array.from({length: width}, (_, k) => (value >>> (8 * k)) & 255)));
}

/// Files as one archive (APPNOTE 6.3.9, 4.3), each deflated. files: {name: bytes}
async function zipOf(files) {
  const deflate = 8, version = 20, utf8Names = 1 << 11, day = (1980 - 1980) << 9 | 1 << 5 | 1;
  const parts = [], list = [];
  let offset = 0, listSize = 0;
  for (const [name, bytes] of Object.entries(files)) {
    const title = new TextEncoder().encode(name), packed = await deflated(bytes);
    const head = numbers([2, version], [2, utf8Names], [2, deflate], [2, 0], [2, day], [4, crcOf(bytes)], [4, packed.length],
      [4, bytes.length], [2, title.length], [2, 0]);
    parts.push(numbers([4, 0x04034b50]), head, title, packed);
    list.push(numbers([4, 0x02014b50], [2, version]), head, numbers([2, 0], [2, 0], [2, 0], [4, 0], [4, offset]), title);
    offset += 4 + head.length + title.length + packed.length;
    listSize += 4 + 2 + head.length + 14 + title.length;
  }
  const count = Object.keys(files).length;
  const end = numbers([4, 0x06054b50], [2, 0], [2, 0], [2, count], [2, count], [4, listSize], [4, offset], [2, 0]);
  return new Blob([...parts, ...list, end], {type: "application/zip"});
}

function download(name, blob) {
  const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
