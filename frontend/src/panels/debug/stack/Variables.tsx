import { type KeyboardEvent, useState } from "react";
import { addDataBreakpoint } from "../../../store/debug/debug";
import {
  countOf,
  forgetEntry,
  keyOf,
  moreBelow,
  setVariable,
  toggleVariable,
  useStack,
  type Variable,
} from "../../../store/debug/stack";
import { reverseTo } from "../../../store/debug/stepping";
import { usePlc } from "../../../store/plc/plc";
import { addToTrace } from "../../../store/trace/added";
import { forceOf, useForces } from "../../../store/watch/forces";
import { addToWatch } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { type MenuItem, useMenu } from "../../../ui/Menu";
import { Tree, type TreeRow } from "../../../ui/Tree";
import { Section } from "./Section";

interface Doing {
  /** Key of the variable whose value is being edited. */
  edited: string | null;
  edit: (key: string | null) => void;
  openMenu: (items: readonly MenuItem[], at: { x: number; y: number }) => void;
  /** In the past nothing can be written. */
  past: boolean;
}

/** The variables of the frame, by their sections; values are edited in place. */
export function Variables() {
  const stack = useStack();
  const past = usePlc((plc) => plc.state?.past != null);
  const [edited, edit] = useState<string | null>(null);
  const { open, menu } = useMenu();
  const doing: Doing = { edited, edit, openMenu: open, past };
  const rows = stack.scopes.flatMap((scope): TreeRow[] => {
    const open = stack.open.has(scope.name);
    const toggle = () => void toggleVariable(scope.name, scope.variablesReference);
    const row: TreeRow = {
      key: scope.name,
      level: 0,
      label: <span className="muted">{scope.name}</span>,
      name: scope.name,
      meta: countOf(scope) || undefined,
      open,
      onToggle: toggle,
    };
    return open ? [row, ...rowsBelow(stack, scope.name, scope.variablesReference, countOf(scope), 1, doing)] : [row];
  });
  if (stack.scopes.length === 0) return null;
  return (
    <Section id="variables" title={t("debug.variables")}>
      <Tree label={t("debug.variables")} rows={rows} />
      {menu}
    </Section>
  );
}

type Stack = ReturnType<typeof useStack.getState>;

function rowsBelow(
  stack: Stack,
  key: string,
  reference: number,
  total: number,
  level: number,
  doing: Doing,
): TreeRow[] {
  const known = stack.below.get(key) ?? [];
  const rows = known.flatMap((variable): TreeRow[] => {
    const inner = keyOf(key, variable);
    const row = variableRow(stack, inner, variable, level, doing);
    const refused = stack.refused.get(inner);
    const note = refused === undefined ? [] : [noteRow(inner, refused, level)];
    if (!row.open) return [row, ...note];
    return [row, ...note, ...rowsBelow(stack, inner, variable.variablesReference, countOf(variable), level + 1, doing)];
  });
  return known.length < total && known.length > 0
    ? [...rows, moreRow(key, reference, total - known.length, level)]
    : rows;
}

function variableRow(stack: Stack, key: string, variable: Variable, level: number, doing: Doing): TreeRow {
  const extra = variable.scanbench;
  const foldable = variable.variablesReference > 0;
  const writable = extra?.writable !== false && !doing.past && !foldable;
  const toggle = () => void toggleVariable(key, variable.variablesReference);
  const begin = () => writable && doing.edit(key);
  return {
    key,
    level,
    open: foldable ? stack.open.has(key) : undefined,
    label: (
      <Line
        keyName={key}
        variable={variable}
        changed={stack.changed.has(key)}
        editing={doing.edited === key}
        onDone={() => doing.edit(null)}
      />
    ),
    name: `${variable.name} = ${variable.value}`,
    title: [`${extra?.path || variable.name} : ${variable.type ?? ""}`, extra?.alias, extra?.address]
      .filter(Boolean)
      .join("\n"),
    drag: extra?.path || undefined,
    onToggle: foldable ? toggle : undefined,
    onActivate: foldable ? toggle : begin,
    onMenu: (at) => doing.openMenu(menuOf(variable, writable, begin), at),
  };
}

function menuOf(variable: Variable, writable: boolean, begin: () => void): MenuItem[] {
  const path = variable.scanbench?.path ?? "";
  const placeless = path === "";
  const on = (access: "change" | "write" | "read") => () => void addDataBreakpoint(path, access);
  return [
    { label: t("debug.set"), hint: "Enter", disabled: !writable, onSelect: begin },
    { label: t("watch.addone"), icon: "eye", disabled: placeless, onSelect: () => addToWatch([path]) },
    {
      label: t("watch.totrace"),
      icon: "trigger",
      disabled: placeless || variable.variablesReference > 0,
      onSelect: () => void addToTrace(path),
    },
    { label: t("debug.break.change"), icon: "bp-data", separated: true, disabled: placeless, onSelect: on("change") },
    { label: t("debug.break.write"), disabled: placeless, onSelect: on("write") },
    { label: t("debug.break.read"), disabled: placeless, onSelect: on("read") },
    {
      label: t("debug.lastwrite"),
      icon: "past",
      separated: true,
      disabled: placeless,
      onSelect: () => void reverseTo(path),
    },
    { label: t("copy.value"), separated: true, onSelect: () => void navigator.clipboard.writeText(variable.value) },
    { label: t("copy.path"), disabled: placeless, onSelect: () => void navigator.clipboard.writeText(path) },
  ];
}

interface LineProps {
  keyName: string;
  variable: Variable;
  changed: boolean;
  editing: boolean;
  onDone: () => void;
}

function Line({ keyName, variable, changed, editing, onDone }: LineProps) {
  const force = useForces((forces) => forceOf(forces, variable.scanbench?.path ?? ""));
  const alias = variable.scanbench?.alias;
  const below = variable.variablesReference > 0;
  return (
    <span className="varline">
      <span className="cut">{variable.name}</span>
      {force && <Icon name="forced" small className="forcedc" />}
      {editing ? (
        <ValueEntry keyName={keyName} variable={variable} onDone={onDone} />
      ) : alias && below ? null : (
        <span
          className={`varvalue mono cut${changed ? " changed" : ""}${below ? " faint" : ""}`}
          data-testid={`variable:${variable.name}`}
        >
          {variable.value}
        </span>
      )}
      {alias && !editing && (
        // The end of the text distinguishes one binding from the next, so the beginning is cut off.
        <span className="varalias faint mono" title={alias} data-testid={`alias:${variable.name}`}>
          <bdi>{alias}</bdi>
        </span>
      )}
    </span>
  );
}

function ValueEntry({ keyName, variable, onDone }: { keyName: string; variable: Variable; onDone: () => void }) {
  const [text, setText] = useState(variable.value);
  async function enter(): Promise<void> {
    if (await setVariable(keyName, variable, text)) onDone();
  }
  function onKeyDown(event: KeyboardEvent<HTMLInputElement>): void {
    event.stopPropagation();
    if (event.key === "Enter") void enter();
    if (event.key !== "Escape") return;
    forgetEntry(keyName);
    onDone();
  }
  return (
    <input
      // biome-ignore lint/a11y/noAutofocus: it appears because somebody asked to type here
      autoFocus
      className="inp sm mono varentry"
      aria-label={t("debug.set.of", { name: variable.name })}
      value={text}
      spellCheck={false}
      onFocus={(event) => event.currentTarget.select()}
      onClick={(event) => event.stopPropagation()}
      onBlur={() => {
        forgetEntry(keyName);
        onDone();
      }}
      onKeyDown={onKeyDown}
      onChange={(event) => setText(event.target.value)}
    />
  );
}

const noteRow = (key: string, message: string, level: number): TreeRow => ({
  key: `${key}!`,
  level,
  label: (
    <span className="st fatal" role="alert" title={message}>
      <Icon name="error" small />
      <span className="cut">{message}</span>
    </span>
  ),
  name: message,
});

const moreRow = (key: string, reference: number, count: number, level: number): TreeRow => ({
  key: `${key}+`,
  level,
  label: <span className="link">{t("debug.more", { count })}</span>,
  name: t("debug.more", { count }),
  onActivate: () => void moreBelow(key, reference),
});
