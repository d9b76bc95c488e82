import { type KeyboardEvent, useEffect, useRef } from "react";
import type { DocumentSymbol } from "vscode-languageserver-types";
import { chainAt, type Level, placeOf } from "../../../logic/project/outline";
import { openFile } from "../../../store/page/navigate";
import { onBreadcrumbs } from "../../../store/project/breadcrumbs";
import { useDocuments } from "../../../store/project/documents";
import { useOutline } from "../../../store/project/outline";
import { useShowsRan } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { symbolIcon } from "../symbolIcons";
import "./breadcrumbs.css";

/** Where the caret is: file, POU, method, section or statement. Each part opens the menu of what is beside it. */
export function Breadcrumbs({ path }: { path: string }) {
  const symbols = useOutline(path);
  const cursor = useDocuments(({ active, cursor }) => (active === path ? cursor : null));
  const last = useRef(cursor);
  if (cursor) last.current = cursor;
  // A text of the past is not the one that the server knows.
  const ran = useShowsRan(path);
  const levels = ran || !last.current ? [] : chainAt(symbols, last.current);
  const inside = ran ? [] : (levels.at(-1)?.symbol.children ?? (levels.length === 0 ? symbols : []));
  const list = useRef<HTMLOListElement>(null);

  useEffect(
    () =>
      onBreadcrumbs(() => {
        if (useDocuments.getState().active !== path) return;
        [...(list.current?.querySelectorAll<HTMLElement>("[data-crumb] > button") ?? [])].at(-1)?.click();
      }),
    [path],
  );

  return (
    <nav className="crumbs" aria-label={t("crumbs.label", { path })}>
      <ol ref={list} onKeyDown={walk}>
        <Crumb label={path} icon="list" items={() => fileItems(path)} hint={t("crumbs.files")} />
        {levels.map((level, depth) => (
          <Crumb
            // biome-ignore lint/suspicious/noArrayIndexKey: a crumb is its depth; what is there changes with the caret
            key={depth}
            label={level.symbol.name}
            icon={symbolIcon(level.symbol)}
            items={() => itemsOf(path, level)}
            hint={t("crumbs.beside", { name: level.symbol.name })}
          />
        ))}
        {inside.length > 0 && (
          <Crumb label="…" items={() => itemsOf(path, { siblings: inside })} hint={t("crumbs.inside")} more />
        )}
      </ol>
    </nav>
  );
}

interface CrumbProps {
  label: string;
  icon?: IconName;
  hint: string;
  items: () => readonly MenuItem[];
  /** What is inside: nothing that the caret is in. */
  more?: boolean;
}

function Crumb({ label, icon, hint, items, more = false }: CrumbProps) {
  return (
    <li data-crumb={more ? undefined : label} className={more ? "" : "grows"}>
      <MenuButton label={more ? hint : label} title={hint} className="crumb" items={items}>
        {icon && <Icon name={icon} small />}
        <span className="cut">{label}</span>
      </MenuButton>
    </li>
  );
}

const itemsOf = (path: string, { symbol: here, siblings }: Partial<Level> & Pick<Level, "siblings">): MenuItem[] =>
  siblings.map((symbol) => ({
    key: keyOf(symbol),
    label: symbol.name,
    icon: symbolIcon(symbol),
    ...(here && { checked: symbol === here }),
    ...(symbol.detail ? { hint: symbol.detail } : {}),
    onSelect: () => {
      const { line, column } = placeOf(symbol);
      openFile(path, line, column);
    },
  }));

const keyOf = (symbol: DocumentSymbol) => `${placeOf(symbol).line}:${placeOf(symbol).column}`;

const fileItems = (path: string): MenuItem[] =>
  useDocuments.getState().files.map((file) => ({
    label: file.path,
    checked: file.path === path,
    onSelect: () => openFile(file.path),
  }));

/** Left and Right go from part to part, Down opens the menu. */
function walk(event: KeyboardEvent<HTMLOListElement>): void {
  const parts = [...event.currentTarget.querySelectorAll<HTMLElement>("button.crumb")];
  const now = parts.indexOf(document.activeElement as HTMLElement);
  const to = { ArrowLeft: now - 1, ArrowRight: now + 1, Home: 0, End: parts.length - 1 }[event.key];
  if (to !== undefined) parts[Math.max(0, Math.min(to, parts.length - 1))]?.focus();
  else if (event.key === "ArrowDown") parts[now]?.click();
  else return;
  event.preventDefault();
}
