/** The pages of the help: made from the files of `docs/` when the page is built, so that both say the same. */
import MarkdownIt, { type StateCore, type Token } from "markdown-it";
import type { Plugin } from "vite";
import type { HelpEntry, HelpPage } from "./src/logic/page/help";

/** Written by people who write well: no HTML of their own, and nothing else is trusted with it. */
const markdown = new MarkdownIt({ html: false });
markdown.core.ruler.push("places", placesOf);
markdown.renderer.rules.table_open = () => '<div class="helptable" tabindex="0"><table>\n';
markdown.renderer.rules.table_close = () => "</table></div>\n";

/** Headings can be linked to, and so can rows that describe one name: `TON(IN : BOOL, ...)`. */
function placesOf({ tokens }: StateCore): void {
  const used = new Set<string>();
  tokens.forEach((token, at) => {
    const inline = tokens[at + 1];
    if (token.type === "heading_open") token.attrSet("id", unique(slug(textOf(inline)), used));
    const name = token.type === "tr_open" ? nameOf(tokens[at + 2]) : undefined;
    if (name !== undefined) token.attrSet("id", unique(name.toLowerCase(), used));
  });
}

const slug = (text: string) =>
  text
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\s_-]/gu, "")
    .trim()
    .replace(/\s/g, "-");

function unique(id: string, used: Set<string>): string {
  let free = id;
  for (let turn = 1; used.has(free); turn += 1) free = `${id}-${turn}`;
  used.add(free);
  return free;
}

const textOf = (token: Token | undefined) => (token?.children ?? []).map(({ content }) => content).join("");

/** The name that a row is about; none, if its first cell is something else. */
function nameOf(cell: Token | undefined): string | undefined {
  const [first] = cell?.children ?? [];
  return first?.type === "code_inline" ? /^([A-Za-z]\w*)\(/.exec(first.content)?.[1] : undefined;
}

/** What a page says about how it is made is for those who change it. */
const GENERATED = /^(?:Made|Written) by [^\n]*; do not edit\.\n/m;

/** A page: its title, its HTML, and the places that a search finds. */
export function helpPage(text: string): HelpPage {
  const tokens = markdown.parse(text.replace(GENERATED, ""), {});
  const entries: HelpEntry[] = [];
  let section: HelpEntry = { id: "", title: "", text: "" };
  let row: HelpEntry | undefined;
  for (const [at, token] of tokens.entries()) {
    const id = String(token.attrGet("id") ?? "");
    if (token.type === "heading_open") {
      section = { id, title: textOf(tokens[at + 1]), text: "" };
      entries.push(section);
    } else if (token.type === "tr_open" && id !== "") {
      row = { id, title: nameOf(tokens[at + 2]) ?? "", text: "" };
      entries.push(row);
    } else if (token.type === "tr_close") row = undefined;
    else if (token.type === "fence") append(section, token.content);
    else if (token.type === "inline" && tokens[at - 1]?.type !== "heading_open") append(row ?? section, textOf(token));
  }
  const html = markdown.renderer.render(tokens, markdown.options, {});
  return { title: entries[0]?.title ?? "", html, entries };
}

function append(entry: HelpEntry, text: string): void {
  entry.text = `${entry.text} ${text}`.trim();
}

/** A Markdown file that is imported is a page of the help. */
export const helpPages: Plugin = {
  name: "help-pages",
  transform: (code, id) => (id.endsWith(".md") ? `export default ${JSON.stringify(helpPage(code))}` : undefined),
};
