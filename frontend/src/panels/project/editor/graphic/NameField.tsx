import { type KeyboardEvent, useId, useState } from "react";
import { elementOf, fieldText } from "../../../../logic/graphic/field";
import type { Drawn } from "../../../../logic/graphic/ladderLayout";
import type { Element } from "../../../../logic/graphic/tree";
import { t } from "../../../../text";
import { nameOf } from "./names";

interface Props {
  drawn: Drawn;
  /** Names that are offered. */
  names: readonly string[];
  onTake: (element: Element, onwards: boolean) => void;
  onLeave: () => void;
}

/** The name of a contact or coil, or the text of a box, where it is drawn. Enter takes it, Tab goes on to the next one, Escape leaves. */
export function NameField({ drawn: { element, x, y, up, width }, names, onTake, onLeave }: Props) {
  const [text, setText] = useState(() => fieldText(element));
  const [bad, setBad] = useState(false);
  const list = useId();
  const wide = element.kind === "contact" || element.kind === "coil" ? Math.max(120, width) : 360;

  function onKeyDown(event: KeyboardEvent<HTMLInputElement>): void {
    event.stopPropagation();
    if (event.key === "Escape") onLeave();
    if (event.key !== "Enter" && event.key !== "Tab") return;
    event.preventDefault();
    const made = elementOf(element.kind, text);
    if (made) onTake(made, event.key === "Tab");
    else setBad(true);
  }

  return (
    <span className="inplace" style={{ left: Math.max(0, x), top: y - up - 6, width: wide }}>
      <input
        // biome-ignore lint/a11y/noAutofocus: it was opened to be typed into
        autoFocus
        className={`inp sm mono${bad ? " bad" : ""}`}
        aria-label={nameOf(element)}
        aria-invalid={bad}
        title={bad ? t("graphic.field.bad") : undefined}
        placeholder={element.kind === "box" ? "timer(IN := ~, PT := T#1s).Q" : undefined}
        list={list}
        autoComplete="off"
        spellCheck={false}
        value={text}
        onChange={({ target }) => {
          setText(target.value);
          setBad(false);
        }}
        onKeyDown={onKeyDown}
        onClick={(event) => event.stopPropagation()}
        onDoubleClick={(event) => event.stopPropagation()}
        onBlur={onLeave}
      />
      <datalist id={list}>
        {names.map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      {bad && (
        <span className="hint bad" role="alert">
          {t("graphic.field.bad")}
        </span>
      )}
    </span>
  );
}
