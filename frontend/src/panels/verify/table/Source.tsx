import { useEffect, useMemo, useRef, useState } from "react";
import { shownValue } from "../../../logic/verify/verifyValues";
import { openFile } from "../../../store/page/navigate";
import { useDocuments } from "../../../store/project/documents";
import { savedText } from "../../../store/project/sourceText";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { VerificationInfo, VerifyDifference } from "../../../wire/types";
import type { Looked } from "./looked";

/** The lines of the range, with the line of the difference marked. */
export function Source({ info, row, difference }: Looked & { info: VerificationInfo }) {
  const place = difference?.place ?? row?.place ?? null;
  const pous = useDocuments((documents) => documents.pous);
  const pou = pous.find(({ name }) => name.toUpperCase() === info.range.pou.toUpperCase());
  const file = place?.file ?? (info.range.file || (pou?.file ?? ""));
  const text = useText(file, info.id);
  const inRange = file === (info.range.file || pou?.file) && info.range.first > 0;
  const lines = useMemo(() => text?.split("\n") ?? [], [text]);
  const top = useRef<HTMLDivElement>(null);
  const marked = place?.line ?? (inRange ? info.range.first : (pou?.line ?? 0));
  const scroller = useRef<HTMLDivElement>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs for a different place or a different text
  useEffect(() => {
    const element = scroller.current;
    if (element && top.current) element.scrollTop = top.current.offsetTop - element.clientHeight / 3;
  }, [file, marked, text]);

  if (file === "" || text === null) {
    return (
      <p className="lonely faint vfcode">{t(file === "" ? "verify.source.none" : "verify.source.gone", { file })}</p>
    );
  }
  const moved = place !== null && place.text !== "" && (lines[place.line - 1] ?? "").trim() !== place.text.trim();
  return (
    <div className="vfcode">
      <div className="vffile">
        <button type="button" className="link mono" onClick={() => openFile(file, marked || 1)}>
          {file}:{marked || 1}
        </button>
        {place && <span className="faint mono cut">{place.instance}</span>}
        {moved && <span className="st halted cut">{t("verify.source.moved")}</span>}
      </div>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard */}
      <div ref={scroller} className="vflines scroll" role="list" aria-label={t("verify.source")} tabIndex={0}>
        {moved && place ? (
          <Line number={place.line} text={place.text} inRange difference={difference} here />
        ) : (
          lines.map((line, at) => {
            const number = at + 1;
            const here = place?.line === number;
            const ranged =
              !inRange || (number >= info.range.first && (info.range.last === 0 || number <= info.range.last));
            return (
              <div key={number} ref={number === marked ? top : undefined}>
                <Line
                  number={number}
                  text={line}
                  inRange={inRange && ranged}
                  difference={here ? difference : null}
                  here={here}
                  off={!ranged}
                />
              </div>
            );
          })
        )}
      </div>
    </div>
  );
}

interface LineProps {
  number: number;
  text: string;
  inRange: boolean;
  difference: VerifyDifference | null;
  here: boolean;
  off?: boolean;
}

function Line({ number, text, inRange, difference, here, off = false }: LineProps) {
  const bad = here && difference !== null;
  return (
    <div
      className={`vfln${inRange ? " range" : ""}${bad ? " diffln" : here ? " here" : ""}${off ? " off" : ""}`}
      role="listitem"
    >
      <span className="g">{bad ? <Icon name="differs" className="diffc" /> : here ? <Icon name="here" /> : null}</span>
      <span className="no">{number}</span>
      <span className="src">{text || "\u00a0"}</span>
      {bad && difference && (
        <span className="iv">
          A <b className="bad">{shownValue({ ...difference, values: [] }, difference.control).text}</b> A′{" "}
          <b>{shownValue({ ...difference, values: [] }, difference.monitor).text}</b>
        </span>
      )}
    </div>
  );
}

/** Null until it is fetched, or when there is none. */
function useText(file: string, verification: number): string | null {
  const [known, setKnown] = useState<{ of: string; text: string | null }>({ of: "", text: null });
  const saved = useDocuments((documents) => documents.open[file]?.savedText);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different verification may be of a different version
  useEffect(() => {
    if (file === "") return;
    let current = true;
    void savedText(file).then((text) => current && setKnown({ of: file, text }));
    return () => {
      current = false;
    };
  }, [file, saved, verification]);
  return known.of === file ? known.text : null;
}
