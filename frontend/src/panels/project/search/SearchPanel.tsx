/** Search and replace in all files of the project, with what each place becomes. */
import { type KeyboardEvent, useEffect, useRef } from "react";
import { type Match, MOST } from "../../../logic/project/search";
import { openFile } from "../../../store/page/navigate";
import { becomes, type FileMatches, look, replace, replaceBy, useSearch } from "../../../store/project/search";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import "./search.css";

const OPTIONS = [
  { name: "cased", sign: "Aa" },
  { name: "whole", sign: "ab" },
  { name: "regex", sign: ".*" },
] as const;

export function SearchPanel() {
  const { text, by, found, unread, bad, asked } = useSearch();
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
          {says(text, bad, found)}
        </span>
      </div>
      {unread.length > 0 && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          {t("search.unread", { paths: unread.join(", ") })}
        </p>
      )}
      <div className="scroll grow" role="region" aria-label={t("search.found")}>
        {found.map((file) => (
          <File key={file.path} file={file} />
        ))}
      </div>
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

function File({ file: { path, matches } }: { file: FileMatches }) {
  const by = useSearch((search) => search.by);
  return (
    <section aria-label={path}>
      <h3>
        <span className="mono">{path}</span>
        <span className="faint">{matches.length}</span>
        <IconButton
          icon="swap"
          label={t("search.file", { path, count: matches.length })}
          onClick={() => void replace([{ path, matches }])}
        />
      </h3>
      <ul>
        {matches.map((match) => (
          <li key={match.at}>
            <button type="button" className="hit" onClick={() => open(path, match)}>
              <span className="mono faint line">{match.line}</span>
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
          </li>
        ))}
      </ul>
    </section>
  );
}
