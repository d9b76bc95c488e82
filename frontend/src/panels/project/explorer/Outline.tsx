import { useEffect, useRef, useState } from "react";
import { declared, keysAt, outlineRows, placeOf } from "../../../logic/project/outline";
import { openFile } from "../../../store/page/navigate";
import { useSection } from "../../../store/page/sections";
import { useDocuments } from "../../../store/project/documents";
import { useOutline } from "../../../store/project/outline";
import { useShowsRan } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Section } from "../../../ui/Section";
import { Tree, type TreeRow } from "../../../ui/Tree";
import { symbolIcon } from "../symbolIcons";
import "./outline.css";

/** What the active file declares, as a tree that follows the caret. */
export function Outline() {
  const section = useSection("outline", false);
  const path = useDocuments(({ active }) => active);
  return (
    <Section
      id="outline"
      title={t("outline.title")}
      meta={section.open && path !== null ? path : undefined}
      {...section}
    >
      <OutlineTree key={path} path={path} />
    </Section>
  );
}

function OutlineTree({ path }: { path: string | null }) {
  const symbols = declared(useOutline(path));
  const cursor = useDocuments(({ active, cursor }) => (active === path ? cursor : null));
  const [looked, setLooked] = useState("");
  const [chosen, setChosen] = useState<ReadonlyMap<string, boolean>>(() => new Map());
  const ran = useShowsRan(path ?? "");
  const host = useRef<HTMLDivElement>(null);

  // What is around the caret is open; so are the first levels of a short file. What somebody opened or closed stays so.
  const around = cursor ? keysAt(symbols, cursor) : [];
  const short = symbols.length <= SHORT;
  const isOpen = (key: string, level: number) => chosen.get(key) ?? (around.includes(key) || (short && level === 0));
  const rows = outlineRows(symbols, isOpen, looked);
  const here = rows.findLast(({ key }) => around.includes(key))?.key;

  useEffect(() => {
    if (here !== undefined) host.current?.querySelector(".tr.on")?.scrollIntoView?.({ block: "nearest" });
  }, [here]);

  if (path === null) return <p className="sectnote">{t("outline.nofile")}</p>;
  if (ran) return <p className="sectnote">{t("outline.past")}</p>;
  return (
    <div ref={host} className="outline">
      <div className="sub">
        <span className="inp sm filter grow">
          <Icon name="search" small />
          <input
            type="search"
            value={looked}
            placeholder={t("outline.filter")}
            aria-label={t("outline.filter")}
            spellCheck={false}
            onChange={(event) => setLooked(event.target.value)}
            onKeyDown={(event) => event.key === "Escape" && setLooked("")}
          />
        </span>
      </div>
      {rows.length === 0 && (
        <p className="sectnote">{looked ? t("outline.filter.none", { text: looked }) : t("outline.nothing")}</p>
      )}
      <Tree
        label={t("outline.title")}
        rows={rows.map(({ key, level, symbol, open }): TreeRow => {
          const place = placeOf(symbol);
          return {
            key,
            level,
            icon: symbolIcon(symbol),
            label: symbol.name,
            name: symbol.name,
            meta: typeOf(symbol.detail),
            open,
            selected: key === here,
            title: [symbol.name, symbol.detail, `${path}:${place.line}`].filter(Boolean).join(" · "),
            ...(open === undefined ? {} : { onToggle: () => setChosen(new Map([...chosen, [key, !open]])) }),
            onActivate: () => openFile(path, place.line, place.column),
          };
        })}
      />
    </div>
  );
}

/** So many declarations are shown with what is in them. */
const SHORT = 8;

/** Of `VAR_INPUT TIME` the type: the section is a row of its own. */
const typeOf = (detail: string | undefined) => detail?.replace(/^VAR\w* /, "") || undefined;
