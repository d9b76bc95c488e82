import { useState } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { nextStep, readersOf, sentenceOf, stretchesOf } from "../../../logic/errors/reaction";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useReaction } from "../../../store/errors/reaction";
import { useWidths } from "../../../store/page/columns";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import { ReactionWord } from "../../../ui/ReactionWord";
import { useColumns } from "../../../ui/useColumns";
import type { ErrorInfo, Reaction, ReactionState } from "../../../wire/types";
import { Evidence } from "../Evidence";
import { Required } from "../Required";

const FIRST = 20;

/** The reaction to the error, or to the instance of it that `of` names: a sentence, the readers, the executed lines, the changed variables, and what to do next. */
export function ReactionView({ error, of, state }: { error: ErrorInfo; of: string; state: ReactionState }) {
  const seen = useReaction();
  const reaction = seen.id === of ? seen.reaction : null;
  const refused = seen.id === of ? seen.refused : null;
  return (
    <section className="reaction" aria-label={t("reaction.label")}>
      <p className="row">
        <ReactionWord reaction={reaction ? { ...state, unmet: 0 } : state} />
        <span className="grow muted">
          {state.state === "done" && reaction && sentenceOf(reaction, error.flag)}
          {state.state === "done" && !reaction && (refused ?? t("reaction.loading"))}
          {state.state === "recording" && (state.message || t("reaction.recording.about"))}
          {state.state === "failed" && state.message}
        </span>
      </p>
      {state.state === "done" && reaction && <Facts error={error} reaction={reaction} />}
    </section>
  );
}

function Facts({ error, reaction }: { error: ErrorInfo; reaction: Reaction }) {
  const next = nextStep(reaction.verdict, error.flag);
  const readers = readersOf(reaction);
  const handlers = stretchesOf(reaction);
  const { errors } = useCatalogue();
  return (
    <>
      <Required {...reaction} />
      {reaction.note && <p className="muted">{inNames(errors, reaction.note)}</p>}
      <Evidence reaction={reaction} onOpen={openFile} />
      {next && (
        <p>
          <b>{t("reaction.next")}</b> {next}
        </p>
      )}
      {readers.length > 0 && (
        <Places
          label={t("reaction.readers")}
          places={readers.map(({ file, line, says }) => ({ file, line, text: `${file}:${line}`, says }))}
        />
      )}
      {handlers.length > 0 && (
        <Places
          label={t("reaction.handlers")}
          places={handlers.map(({ file, from, to }) => ({
            file,
            line: from,
            text: from === to ? `${file}:${from}` : `${file}:${from}–${to}`,
            says: "",
          }))}
        />
      )}
      <Differences reaction={reaction} />
    </>
  );
}

interface PlaceLink {
  file: string;
  line: number;
  text: string;
  says: string;
}

function Places({ label, places }: { label: string; places: readonly PlaceLink[] }) {
  const [all, setAll] = useState(false);
  const shown = all ? places : places.slice(0, FIRST);
  return (
    <div className="places" role="group" aria-label={label}>
      <span className="faint">{label}</span>
      {shown.map(({ file, line, text, says }) => (
        <span key={text}>
          <button type="button" className="link mono" onClick={() => openFile(file, line)}>
            {text}
          </button>
          {says && <span className="faint"> {says}</span>}
        </span>
      ))}
      {places.length > shown.length && (
        <button type="button" className="link" onClick={() => setAll(true)}>
          {t("reaction.more", { count: places.length - shown.length })}
        </button>
      )}
    </div>
  );
}

function Differences({ reaction }: { reaction: Reaction }) {
  const [all, setAll] = useState(false);
  const { th } = useColumns(useWidths("reaction"));
  const { differences, difference_count: count } = reaction;
  if (differences.length === 0) return null;
  const shown = all ? differences : differences.slice(0, FIRST);
  return (
    <table className="differences" aria-label={t("reaction.differences")}>
      <thead>
        <tr>
          {th("variable", t("reaction.differences"))}
          {th("without", t("reaction.without"), "num")}
          {th("with", t("reaction.with"), "num")}
          <th scope="col" className="num">
            {t("log.scan")}
          </th>
        </tr>
      </thead>
      <tbody>
        {shown.map(({ path, without, value, output, scan }) => (
          <tr key={path}>
            <th scope="row" className="mono" title={path}>
              {path}
              {output && <span className="faint"> {t("reaction.output")}</span>}
            </th>
            <td className="num" title={without}>
              {without}
            </td>
            <td className="num" title={value}>
              {value}
            </td>
            <td className="num faint">{scan}</td>
          </tr>
        ))}
        {count > shown.length && (
          <tr>
            <td colSpan={4}>
              {differences.length > shown.length ? (
                <button type="button" className="link" onClick={() => setAll(true)}>
                  {t("reaction.more", { count: count - shown.length })}
                </button>
              ) : (
                <span className="faint">{t("reaction.more", { count: count - shown.length })}</span>
              )}
            </td>
          </tr>
        )}
      </tbody>
    </table>
  );
}
