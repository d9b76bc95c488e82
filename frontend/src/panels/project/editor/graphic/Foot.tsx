import type { Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { fitDrawings, showTools, useFit, useShowsTools } from "../../../../store/graphic/views";
import { type TextKey, t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import type { Pou } from "../../../../wire/types";
import { FlowNote } from "./FlowNote";
import type { Note } from "./Notes";
import { Tools } from "./Tools";
import { WrongNote } from "./WrongNote";
import type { Wrong } from "./wrong";

interface Props {
  path: string;
  kind: DrawnPart["kind"];
  readOnly: boolean;
  /** At the cursor, and its place. */
  part: DrawnPart | undefined;
  place: Place;
  pou: Pou | undefined;
  /** Why the last edit was not done. */
  refused: TextKey | null;
  /** What is wrong at the cursor. */
  wrong: Wrong | null;
  /** What is said of all of the part. */
  notes: readonly Note[];
  onPress: (key: string) => void;
  onFile: () => void;
}

/** Below the drawing: its keys as buttons, what is known of the element at the cursor, and what is done with all of it. */
export function Foot({ path, kind, readOnly, part, place, pou, refused, wrong, notes, onPress, onFile }: Props) {
  const fit = useFit();
  const tools = useShowsTools();
  return (
    <>
      {!readOnly && tools && <Tools kind={kind} onPress={onPress} />}
      <div className="netnote faint">
        <FlowNote path={path} part={part} place={part?.kind === "network" ? place.slice(0, 1) : place} pou={pou} />
        {wrong && !refused ? (
          <WrongNote path={path} problem={wrong.problem} readOnly={readOnly} />
        ) : (
          <Said notes={refused ? [{ look: "bad", text: t(refused) }] : notes} readOnly={readOnly} />
        )}
        {!readOnly && (
          <button
            type="button"
            className="btn quiet sm"
            title={t("graphic.tools.hint")}
            aria-pressed={tools}
            onClick={() => showTools(!tools)}
          >
            <Icon name="keyboard" small />
            <span className="word">{t("graphic.tools.short")}</span>
          </button>
        )}
        <button
          type="button"
          className="btn quiet sm"
          title={t("graphic.fit.hint")}
          aria-pressed={fit}
          onClick={() => fitDrawings(!fit)}
        >
          <Icon name="fit" small />
          <span className="word">{t("graphic.fit")}</span>
        </button>
        <button type="button" className="btn quiet sm" title={t("graphic.print.hint")} onClick={() => print()}>
          <Icon name="printer" small />
          <span className="word">{t("graphic.print")}</span>
        </button>
        <button type="button" className="btn quiet sm" title={t("graphic.svg.hint")} onClick={onFile}>
          <Icon name="export" small />
          <span className="word">{t("graphic.svg")}</span>
        </button>
      </div>
    </>
  );
}

/** What is to be said at the cursor, whole; else which keys there are, as far as there is room. */
function Said({ notes, readOnly }: { notes: readonly Note[]; readOnly: boolean }) {
  const said = notes.map(({ text }) => text).join("; ");
  return (
    <span className={said === "" ? "cut grow" : `said ${notes[0]?.look}`} role="status">
      {said || t(readOnly ? "graphic.readonly" : "graphic.keys")}
    </span>
  );
}
