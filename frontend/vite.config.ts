import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// `npm run dev` serves the page with hot reload and passes /api on to a running `scanbench serve`.
const backend = process.env.SCANBENCH_URL ?? "http://127.0.0.1:8765";

export default defineConfig({
  plugins: [react()],
  // The page also stands at `/i/3/scan/4711`: what it needs is at the root.
  base: "/",
  build: {
    // Monaco is one chunk of 4 MB by nature; it is loaded after the shell has painted.
    chunkSizeWarningLimit: 5000,
  },
  server: { proxy: { "/api": { target: backend, ws: true } } },
});
