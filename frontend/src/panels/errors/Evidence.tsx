import { useState } from "react";
import { basisOf, evidenceOf, placeOf } from "../../logic/errors/evidence";
import { t } from "../../text";
import type { Reaction } from "../../wire/types";

const FIRST = 10;

interface Props {
  reaction: Reaction;
  onOpen: (file: string, line: number) => void;
}

/** Why the error has its grade: words, state and statements, and whether the runs or the program's text say so. */
export function Evidence({ reaction, onOpen }: Props) {
  const basis = basisOf(reaction);
  return (
    <>
      {basis && <p className="hint">{basis}</p>}
      {evidenceOf(reaction).map((group) => (
        <Group key={group.label} group={group} onOpen={onOpen} />
      ))}
    </>
  );
}

function Group({ group, onOpen }: { group: ReturnType<typeof evidenceOf>[number]; onOpen: Props["onOpen"] }) {
  const [all, setAll] = useState(false);
  const { label, items } = group;
  const shown = all ? items : items.slice(0, FIRST);
  return (
    <div className="evidence" role="group" aria-label={label}>
      <span className="faint">{label}</span>
      {shown.map(({ text, place, says, readers }) => (
        <span key={text}>
          {place ? <Link text={text} onOpen={onOpen} /> : <span className="mono">{text}</span>}
          {says && <span className="faint"> {says}</span>}
          {readers.map((reader) => (
            <span key={reader}>
              {" "}
              <Link text={reader} onOpen={onOpen} />
            </span>
          ))}
        </span>
      ))}
      {items.length > shown.length && (
        <button type="button" className="link" onClick={() => setAll(true)}>
          {t("reaction.more", { count: items.length - shown.length })}
        </button>
      )}
    </div>
  );
}

function Link({ text, onOpen }: { text: string; onOpen: Props["onOpen"] }) {
  const place = placeOf(text);
  if (place === null) return <span className="mono">{text}</span>;
  return (
    <button type="button" className="link mono" onClick={() => onOpen(place.file, place.line)}>
      {text}
    </button>
  );
}
