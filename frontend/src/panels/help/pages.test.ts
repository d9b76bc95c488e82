import { describe, expect, it } from "vitest";
import { helpPage } from "../../../helpPages";
import { placeOf, problemHelp, standardHelp, topicOf, topics } from "../../logic/page/help";
import { PANELS } from "../../store/page/navigate";
import { isThere, pages, search } from "./pages";

const linksOf = (html: string) => [...html.matchAll(/<a href="([^"]*)"/g)].map(([, href = ""]) => href);

describe("the help", () => {
  it("has a place for every panel", () => {
    expect(topics.filter((topic) => !isThere(topicOf(topic)))).toEqual([]);
    expect(PANELS.filter((panel) => !topics.includes(panel))).toEqual([]);
  });

  it("has pages whose links lead to places that there are", () => {
    const dead = [...pages].flatMap(([path, { html }]) =>
      linksOf(html).flatMap((href) => {
        const place = placeOf(href.replaceAll("&amp;", "&"), path);
        return place === null || isThere(place) ? [] : [`${path}: ${href}`];
      }),
    );
    expect(dead).toEqual([]);
    expect(pages.size).toBeGreaterThan(60);
  });

  it("has each problem that the list of problems names, and each standard block under its name", () => {
    const listed = [...(pages.get("problems/README.md")?.html ?? "").matchAll(/href="([A-Z]\d{3})\.md"/g)];
    expect(listed.length).toBeGreaterThan(40);
    expect(listed.map(([, code = ""]) => problemHelp(code)).filter((place) => !isThere(place))).toEqual([]);
    for (const name of ["TON", "CTU_DINT", "ABS", "CONCAT", "R_TRIG", "LIMIT"])
      expect(isThere(standardHelp(name))).toBe(true);
    expect(isThere(standardHelp("motor"))).toBe(false);
  });

  it("finds a block by its name first, and pages by all the words", () => {
    expect(search("ton")[0]).toMatchObject({ path: "standard-library.md", id: "ton", title: "TON" });
    expect(search("coverage")[0]).toMatchObject({ path: "debugger.md", id: "coverage" });
    expect(search("D001")[0]?.path).toBe("problems/D001.md");
    expect(search("duplicate private list").map(({ path }) => path)).toContain("watch.md");
    expect(search("nothingsaysthis")).toEqual([]);
  });

  it("finds pages for users before those for developers", () => {
    for (const words of ["instance", "force", "breakpoint", "model"]) {
      const found = search(words).map(({ path }) => /^(\.\.\/|api|dap|features|formats|lsp|scripts)/.test(path));
      expect(found[0]).toBe(false);
      expect(found).toEqual([...found].sort());
    }
  });

  it("shows the HTML of a text as text, and gives headings of the same words places of their own", () => {
    const { html, entries } = helpPage("# A & B\n\n<script>alert(1)</script>\n\n## Same\n\nOne\n\n## Same\n\nTwo\n");
    expect(html).not.toContain("<script>");
    expect(html).toContain("&lt;script&gt;");
    expect(entries.map(({ id, text }) => [id, text])).toEqual([
      ["a--b", "<script>alert(1)</script>"],
      ["same", "One"],
      ["same-1", "Two"],
    ]);
  });
});
