import { waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { useWatches } from "../../../store/plc/watches";
import { openPage } from "../../../testing/page";
import { symbol } from "../../../testing/samples";
import { liveHover } from "./liveHover";

/** What Monaco draws: a line of spans, in which blanks do not break. */
function drawHover(text: string): HTMLElement {
  const hover = document.createElement("div");
  hover.className = "monaco-hover";
  hover.innerHTML = `<div class="monaco-tokenized-source"><span>${text.replaceAll(" ", "\u00a0")}</span></div>`;
  document.body.append(hover);
  // jsdom lays nothing out: what is in the document counts as visible.
  const line = hover.firstElementChild as HTMLElement;
  Object.defineProperty(line, "offsetParent", { get: () => (line.isConnected ? document.body : null) });
  return hover;
}

test("the value of an open hover is the live one, and nothing is watched once it is closed", async () => {
  const { server } = await openPage((server) => server.has(symbol("Main.speed", "INT"), 5));
  const hover = drawHover("speed : INT := 5");
  liveHover("speed : INT", "Main.speed");
  await waitFor(() => expect(useWatches.getState().symbols.has("Main.speed")).toBe(true));
  server.set("Main.speed", 17);
  await waitFor(() => expect(hover.textContent).toBe("speed : INT := 17"));
  server.set("Main.speed", 18);
  await waitFor(() => expect(hover.textContent).toBe("speed : INT := 18"));
  hover.remove();
  await waitFor(() => expect(server.sentOf("unwatch")).toHaveLength(1));
});

test("a value that is not known leaves what was said", async () => {
  await openPage();
  const hover = drawHover("a + b : INT := 5");
  const end = liveHover("a + b : INT", "a + b");
  await waitFor(() => expect(useWatches.getState().refusals.has("a + b")).toBe(true));
  expect(hover.textContent?.replaceAll("\u00a0", " ")).toBe("a + b : INT := 5");
  hover.remove();
  end();
});
