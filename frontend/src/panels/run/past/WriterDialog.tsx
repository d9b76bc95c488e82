import type { ReactNode } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { grouped } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { openFile } from "../../../store/page/navigate";
import { closeChanges } from "../../../store/past/changes";
import { closeWriter, goToWriter, showWriter, useWriter } from "../../../store/past/writer";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { isDirty, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Icon, type IconName } from "../../../ui/Icon";
import { StateWord } from "../../../ui/StateWord";
import type { LastWriter } from "../../../wire/types";

const LOOK: Record<LastWriter["by"], { icon: IconName; tone: string }> = {
  program: { icon: "program", tone: "running" },
  command: { icon: "cmd", tone: "info" },
  plc: { icon: "plc", tone: "stopped" },
  start: { icon: "init", tone: "never" },
};

/** Who last wrote a variable: the statement with its instance, or the command with its author; and where to go from there. */
export function WriterDialog() {
  const { asked, found, refused } = useWriter();
  if (asked === null) return null;
  return (
    <Dialog
      title={t("writer.title", { path: found?.path ?? asked.path })}
      width={600}
      onClose={closeWriter}
      footer={<Ways found={found} />}
    >
      <div className="writer" aria-busy={found === null && refused === null}>
        {refused !== null ? (
          <p className="trouble st fatal" role="alert">
            <Icon name="error" small />
            <span>{refused}</span>
          </p>
        ) : found === null ? (
          <p className="lonely faint" role="status">
            {t("writer.loading")}
          </p>
        ) : (
          <Found found={found} />
        )}
      </div>
    </Dialog>
  );
}

function Found({ found }: { found: LastWriter }) {
  const { errors } = useCatalogue();
  const { by, place, author, text, scan, shown } = found;
  return (
    <>
      <StateWord {...LOOK[by]} word={t(`writer.by.${by}`)} />
      {place ? <code className="stmt mono">{place.text || text}</code> : <p>{inNames(errors, text)}</p>}
      <dl className="wfacts">
        {by !== "start" && <Fact name={t("writer.scan")}>{grouped(scan)}</Fact>}
        {place && (
          <>
            <Fact name={t("writer.place")}>{`${place.file}:${place.line}`}</Fact>
            <Fact name={t("writer.instance")}>{place.instance || place.pou}</Fact>
            <Fact name={t("writer.task")}>{place.task}</Fact>
          </>
        )}
        {author && <Fact name={t("writer.author")}>{author}</Fact>}
        <Fact name={t("writer.value")}>{shown}</Fact>
      </dl>
      {place && <Edited file={place.file} line={place.line} />}
    </>
  );
}

function Fact({ name, children }: { name: string; children: ReactNode }) {
  if (children === "") return null;
  return (
    <div>
      <dt>{name}</dt>
      <dd className="mono">{children}</dd>
    </div>
  );
}

/** The statement belongs to the built text; the text in the editor may differ by now. */
function Edited({ file, line }: { file: string; line: number }) {
  const dirty = useDocuments((documents) => isDirty(documents.open[file]));
  const version = usePlc((plc) => plc.state?.program_version ?? 0);
  if (!dirty) return null;
  return (
    <p className="st warning note">
      <Icon name="warning" small />
      <span>{t("writer.edited", { line, version })}</span>
    </p>
  );
}

function Ways({ found }: { found: LastWriter | null }) {
  const locked = useForbidden("travel");
  const place = found?.place;
  const show = () => {
    closeWriter();
    closeChanges();
    if (place) openFile(place.file, place.line);
  };
  const go = () => {
    closeChanges();
    if (found) goToWriter(found);
  };
  return (
    <>
      {found && found.by !== "start" && (
        <button
          type="button"
          className="btn quiet"
          title={t("writer.again.hint", { scan: grouped(found.scan) })}
          onClick={() => showWriter(found.path, found.scan)}
        >
          <Icon name="step-back" small />
          {t("writer.again")}
        </button>
      )}
      <span className="grow" />
      {!found && (
        <button type="button" className="btn" onClick={closeWriter}>
          {t("close")}
        </button>
      )}
      {place && (
        <button type="button" className="btn" onClick={show}>
          {t("writer.show")}
        </button>
      )}
      {found && (
        <button
          type="button"
          className="btn primary"
          disabled={locked !== null}
          title={locked ?? t("writer.goto.hint")}
          onClick={go}
        >
          {t("writer.goto")}
        </button>
      )}
    </>
  );
}
