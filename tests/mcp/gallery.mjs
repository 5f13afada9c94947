// Ten jobs of the gallery, done through `ashlar mcp` alone by the protocol's reference library: a question, the page that tells
// how, the scene, its faults, its blocks, the run, polled to its end, the answer, and a picture.
//
// use: node gallery.mjs ASHLAR [--without-pictures]
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";

const [program, ...options] = process.argv.slice(2);
const withPictures = !options.includes("--without-pictures");
const g = 9.81, degree = Math.PI / 180;
const near = (value, expected, share) =>
  assert.ok(Math.abs(value - expected) <= share * Math.abs(expected), `${value}, ${expected} is expected`);

/// Sliding down a plane of 30 degrees for a second.
const slid = (friction) => 0.5 * g * (Math.sin(30 * degree) - Math.cos(30 * degree) * Math.tan(friction * degree));
const length = (last, point) => Math.hypot(...["ux", "uy", "uz"].map((name) => last[`${point}.${name}`]));

// Expected values are those of the formula named, see the first lines of the scenes.
const jobs = [
  { question: "a stone slides down a slope", kind: "example:slope", status: "completed", columns: ["sole.ux", "sole.uy", "sole.uz"],
    judge: ({ last }) => near(length(last, "sole"), slid(20), 0.01) },
  { question: "friction angle of a joint between two blocks", kind: "example:incline", status: "completed",
    columns: ["sticker", "slider", "icy"].flatMap((point) => ["ux", "uy", "uz"].map((name) => `${point}.${name}`)),
    judge: ({ last }) => {
      assert.ok(length(last, "sticker") < 1e-3);
      near(length(last, "slider"), slid(20), 0.01);
      near(length(last, "icy"), slid(0), 0.01);
    } },
  { question: "wedge on two joint planes", kind: "example:wedge", status: "completed", columns: ["tip.ux", "tip.uy", "tip.uz"],
    judge: ({ last }) => near(length(last, "tip"), 0.5 * 0.269 * g, 0.02) },
  { question: "excavate a tunnel in stages", kind: "example:tunnel_roof", status: "completed",
    judge: ({ summary }) => near(summary.largest_displacement.value, 0.5 * g * 0.6 ** 2, 0.1) },
  { question: "bolts that hold the roof of a tunnel", kind: "example:bolted_roof", status: "equilibrium" },
  { question: "does a masonry arch stand", kind: "example:arch_stands", status: "equilibrium" },
  { question: "hinges of an arch that collapses", kind: "example:arch_collapses", status: "completed", columns: ["crown.uz"],
    judge: ({ last }) => assert.ok(last["crown.uz"] < -0.1) },
  { question: "a static analysis of a thin arch", kind: "example:arch_stands", file: "thin.toml",
    set: { "parameters.thick": "= 0.95 * 0.10678" }, status: "moving" },
  { question: "equilibrium of a dome", kind: "example:dome", status: "equilibrium" },
  { question: "factor of safety of a rock slope", kind: "slope", file: "plane.toml", status: "completed",
    // Plane slide without cohesion: tan(30 deg) / tan(35 deg).
    judge: ({ summary }) => {
      const exact = Math.tan(30 * degree) / Math.tan(35 * degree);
      assert.ok(summary.factor_of_safety.lower <= exact * (1 + 1e-6) && summary.factor_of_safety.upper >= exact * (1 - 1e-6));
    } },
];

/// Result of a tool that must not be refused.
async function call(client, name, parameters) {
  const result = await client.callTool({ name, arguments: parameters }, undefined,
    { timeout: 600_000, resetTimeoutOnProgress: true, onprogress: () => {} });
  assert.ok(!result.isError, `${name}: ${JSON.stringify(result.content)}`);
  return result;
}

async function run(client, scene, set) {
  let told = (await call(client, "run_start", { scene, set })).structuredContent;
  while (told.state !== "ended") told = (await call(client, "run_status", { run: told.run, wait_seconds: 30 })).structuredContent;
  return told;
}

async function doJob(client, job) {
  const passages = (await call(client, "search_book", { query: job.question })).structuredContent.passages;
  assert.ok((await client.readResource({ uri: passages[0].uri })).contents[0].text.length > 100);
  const scene = job.file ?? `${job.kind.replace("example:", "")}.toml`;
  await call(client, "new_scene", { kind: job.kind, file: scene });
  const set = job.set ?? {};
  const report = (await call(client, "check", { scene, set })).structuredContent;
  assert.ok(report.good, JSON.stringify(report.faults));
  const blocks = (await call(client, "blocks", { scene, set, count: 5 })).structuredContent;
  assert.equal(blocks.count, report.blocks);
  const end = await run(client, scene, set);
  assert.equal(end.status, job.status, JSON.stringify(end));
  const summary = (await call(client, "summary", { folder: end.folder })).structuredContent;
  const last = {};
  if (job.columns) {
    const history = (await call(client, "history", { folder: end.folder, columns: job.columns })).structuredContent;
    for (const column of history.columns) last[column.column] = column.last;
  }
  job.judge?.({ summary, last });
  if (!withPictures) return;
  const picture = await call(client, "picture", { folder: end.folder, size: "320x240" });
  const image = picture.content.find((part) => part.type === "image");
  assert.equal(Buffer.from(image.data, "base64").subarray(1, 4).toString(), "PNG");
}

const folder = mkdtempSync(join(tmpdir(), "ashlar-mcp-"));
const client = new Client({ name: "gallery", version: "1.0.0" });
try {
  await client.connect(new StdioClientTransport({ command: program, args: ["mcp", "--folder", folder], stderr: "inherit" }));
  assert.equal(client.getServerVersion().name, "ashlar");
  assert.ok((await client.listTools()).tools.length > 10);
  await client.ping();
  for (const job of jobs) {
    const begin = Date.now();
    await doJob(client, job);
    console.log(`good: ${job.question} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  }
} finally {
  await client.close();
  rmSync(folder, { recursive: true, force: true });
}
console.log(`${jobs.length} jobs`);
