import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants, gzip } from "node:zlib";
import react from "@vitejs/plugin-react";
import { defineConfig, type Plugin } from "vite";
import { helpPages } from "./helpPages.ts";

// `npm run dev` serves the page with hot reload and passes /api on to a running `scanbench serve`.
const backend = process.env.SCANBENCH_URL ?? "http://127.0.0.1:8765";

/** A seventh smaller than gzip. The highest quality, 11, saves another tenth and takes ten times as long. */
const BROTLI = { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } };

/** Writes compressed copies beside each file: the server sends one of them, and compresses nothing itself. */
const compressed: Plugin = {
  name: "compressed",
  apply: "build",
  async writeBundle({ dir = "dist" }, bundle) {
    const files = Object.keys(bundle).filter((name) => name.startsWith("assets/"));
    for (const file of files.map((name) => join(dir, name))) {
      const content = await readFile(file);
      await writeFile(`${file}.gz`, await promisify(gzip)(content, { level: 9 }));
      await writeFile(`${file}.br`, await promisify(brotliCompress)(content, BROTLI));
    }
  },
};

export default defineConfig({
  plugins: [react(), helpPages, compressed],
  // The page is also served at `/i/3/scan/4711`, so its files are addressed from the root.
  base: "/",
  build: {
    // The licences of what is bundled go into the wheel (`.vite/license.md`).
    license: true,
    // Monaco is one chunk of 4 MB by nature; it is loaded after the shell was painted, and does not change when the page does.
    chunkSizeWarningLimit: 5000,
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            // Helpers of the build are needed by all chunks, and must not make the first chunk import Monaco.
            { name: "runtime", test: /\0/, priority: 1 },
            // Without its words in other languages, of which one is loaded, and before it.
            { name: "monaco", test: /node_modules[\\/]monaco-editor[\\/](?!.*[\\/]nls[\\/]lang[\\/])/ },
          ],
        },
      },
    },
  },
  server: { fs: { allow: [".."] }, proxy: { "/api": { target: backend, ws: true } } },
});
