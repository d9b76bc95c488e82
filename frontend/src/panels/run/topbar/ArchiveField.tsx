import { useEffect, useRef, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { isProjectFile } from "../../../logic/project/explorer";
import { lookAtArchive } from "../../../store/project/newProject";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { ProjectArchive } from "../../../wire/types";

interface Props {
  /** Looked at without being chosen here. */
  dropped?: File | null;
  onChoose: (chosen: Chosen) => void;
}

/** Nothing; a file that is being looked at, or that has no project; a file and what it has. */
export type Chosen = "none" | "not yet" | { file: File; found: ProjectArchive };

/** Asks for a zip, PLCopen or L5X file with the files of a new project, and tells what it has. */
export function ArchiveField({ dropped = null, onChoose }: Props) {
  const [found, setFound] = useState<ProjectArchive | null>(null);
  const [refused, setRefused] = useState<string | null>(null);

  const [chosen, setChosen] = useState(false);
  const turn = useRef(0);

  async function choose(file: File | null): Promise<void> {
    turn.current += 1;
    const mine = turn.current;
    setFound(null);
    setRefused(null);
    const single = file !== null && isProjectFile(file.name);
    if (single) setRefused(t("newproject.archive.single", { name: file.name }));
    onChoose(file && !single ? "not yet" : "none");
    if (!file || single) return;
    try {
      const has = await lookAtArchive(file);
      if (mine !== turn.current) return;
      setFound(has);
      onChoose({ file, found: has });
    } catch (error) {
      if (mine === turn.current) setRefused(messageOf(error));
    }
  }

  const begin = useRef(() => void choose(dropped));
  useEffect(() => begin.current(), []);

  return (
    <label className="field">
      <span>{t("newproject.archive")}</span>
      <input
        type="file"
        accept=".zip,.xml,.l5x"
        className="inp file"
        aria-invalid={refused !== null}
        onChange={({ target }) => {
          setChosen(true);
          void choose(target.files?.[0] ?? null);
        }}
      />
      {found && <span className="hint">{`${dropped && !chosen ? `${dropped.name}: ` : ""}${says(found)}`}</span>}
      {found && found.notes.length > 0 && (
        <>
          <span className="hint">{t("newproject.archive.notes")}</span>
          <ul className="hint notes" aria-label={t("newproject.archive.notes")}>
            {found.notes.map((note) => (
              <li key={note}>{note}</li>
            ))}
          </ul>
        </>
      )}
      {refused && (
        <span className="hint bad" role="alert">
          <Icon name="error" small />
          {refused}
        </span>
      )}
    </label>
  );
}

const SHOWN = 3;

function says({ files, left_out }: ProjectArchive): string {
  if (left_out.length === 0) return t("newproject.archive.has", { count: files.length });
  const names = left_out.slice(0, SHOWN).join(", ") + (left_out.length > SHOWN ? ", …" : "");
  return t("newproject.archive.left", { count: files.length, left: left_out.length, names });
}
