/** Search and replace in all files of the project, with what each place becomes. */
import { type KeyboardEvent, useEffect, useMemo, useRef } from "react";
import { type Match, MOST } from "../../../logic/project/search";
import { openFile } from "../../../store/page/navigate";
import { becomes, look, replace, replaceBy, useSearch } from "../../../store/project/search";
import type { FileMatches } from "../../../store/project/searching";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { useGrid } from "../../../ui/useGrid";
import "./search.css";

const OPTIONS = [
  { name: "cased", sign: "Aa" },
  { name: "whole", sign: "ab" },
  { name: "regex", sign: ".*" },
] as const;

export function SearchPanel() {
  const { text, by, found, unread, bad, slow, asked } = useSearch();
  const field = useRef<HTMLInputElement>(null);
  const count = sum(found);
  useEffect(() => {
    if (asked > 0) field.current?.select();
  }, [asked]);

  function onKey({ key }: KeyboardEvent): void {
    const [first] = found;
    if (key === "Enter" && first?.matches[0]) open(first.path, first.matches[0]);
  }

  return (
    <div className="pane flexcol search" data-pane="search">
      <div className="bar">
        <input
          ref={field}
          className="inp"
          aria-label={t("search.text")}
          placeholder={t("search.text")}
          aria-invalid={bad}
          value={text}
          spellCheck={false}
          onChange={({ target }) => look({ text: target.value })}
          onKeyDown={onKey}
        />
        <Options />
        <input
          className="inp"
          aria-label={t("search.by")}
          placeholder={t("search.by")}
          value={by}
          spellCheck={false}
          onChange={({ target }) => replaceBy(target.value)}
        />
        <button type="button" className="btn" disabled={count === 0} onClick={() => void replace(found)}>
          {t("search.all", { count })}
        </button>
        <span className="faint" role="status">
          {slow ? t("search.slow") : says(text, bad, found)}
        </span>
      </div>
      {unread.length > 0 && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          {t("search.unread", { paths: unread.join(", ") })}
        </p>
      )}
      <Results />
    </div>
  );
}

function says(text: string, bad: boolean, found: readonly FileMatches[]): string {
  if (bad) return t("search.bad");
  if (text === "") return t("search.about");
  if (found.length === 0) return t("search.none");
  const cut = found.find(({ matches }) => matches.length === MOST);
  if (cut) return t("search.most", { most: MOST, path: cut.path });
  return t("search.count", { count: sum(found), files: found.length });
}

const sum = (found: readonly FileMatches[]) => found.reduce((count, { matches }) => count + matches.length, 0);

const open = (path: string, { line, column }: Match) => openFile(path, line, column);

function Options() {
  const wanted = useSearch();
  return (
    <span className="set" role="group" aria-label={t("search.how")}>
      {OPTIONS.map(({ name, sign }) => (
        <button
          key={name}
          type="button"
          className={`ib${wanted[name] ? " is-on" : ""}`}
          aria-pressed={wanted[name]}
          aria-label={t(`search.${name}`)}
          title={t(`search.${name}`)}
          onClick={() => look({ [name]: !wanted[name] })}
        >
          {sign}
        </button>
      ))}
    </span>
  );
}

interface Row {
  file: FileMatches;
  /** Null: the line with the name of the file. */
  match: Match | null;
}

/** Files and their matches, line by line: of thousands only those that can be seen are in the page. */
function Results() {
  const found = useSearch((search) => search.found);
  const rows = useMemo(
    () => found.flatMap((file): Row[] => [{ file, match: null }, ...file.matches.map((match) => ({ file, match }))]),
    [found],
  );
  const { scroll, items, body, topOf } = useGrid({ count: rows.length, head: 0 });
  return (
    <div className="scroll grow" ref={scroll} role="region" aria-label={t("search.found")}>
      <div {...body} role="list">
        {items.map((item) => {
          const row = rows[item.index];
          return (
            row && (
              <div
                key={item.key}
                className={row.match ? "line" : "line head"}
                role="listitem"
                aria-setsize={rows.length}
                aria-posinset={item.index + 1}
                style={{ transform: `translateY(${topOf(item)}px)` }}
              >
                {row.match ? <Hit path={row.file.path} match={row.match} /> : <Head file={row.file} />}
              </div>
            )
          );
        })}
      </div>
    </div>
  );
}

function Head({ file: { path, matches } }: { file: FileMatches }) {
  return (
    <>
      <span className="mono">{path}</span>
      <span className="faint">{matches.length}</span>
      <IconButton
        icon="swap"
        label={t("search.file", { path, count: matches.length })}
        onClick={() => void replace([{ path, matches }])}
      />
    </>
  );
}

function Hit({ path, match }: { path: string; match: Match }) {
  const by = useSearch((search) => search.by);
  return (
    <>
      <button type="button" className="hit" onClick={() => open(path, match)}>
        <span className="mono faint number">{match.line}</span>
        <span className="mono cut">
          {match.before}
          <mark className={by === "" ? "" : "gone"}>{match.groups[0]?.split("\n")[0]}</mark>
          {by !== "" && <ins>{becomes(match)}</ins>}
          {match.after}
        </span>
      </button>
      <IconButton
        icon="swap"
        label={t("search.one", { path, line: match.line })}
        onClick={() => void replace([{ path, matches: [match] }])}
      />
    </>
  );
}
