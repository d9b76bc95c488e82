import { useEffect, useState } from "react";
import {
  changeDialect,
  DIALECTS,
  type Dialect,
  loadDialect,
  useDialect,
  useDialectVersion,
} from "../../../store/project/dialect";
import { t } from "../../../text";
import { IconButton } from "../../../ui/IconButton";
import { Libraries } from "./Libraries";
import { Subranges } from "./Subranges";
import "./libraries.css";

/** The dialect that the programs of the project are written in: shown, and changed. */
export function DialectChoice({ project }: { project: number }) {
  const { dialect, trouble } = useDialect();
  const [open, setOpen] = useState<"libraries" | "subranges" | null>(null);
  const version = useDialectVersion();
  // biome-ignore lint/correctness/useExhaustiveDependencies: a new version of the file may name a different dialect
  useEffect(() => void loadDialect(project), [project, version]);
  if (dialect === null) return null;
  return (
    <>
      <div className="sub dialect">
        <label className="grow" title={t("dialect.about")}>
          <span>{t("dialect")}</span>
          <select
            className="inp sm grow"
            value={dialect}
            onChange={(event) => void changeDialect(project, event.target.value as Dialect)}
          >
            {DIALECTS.map((one) => (
              <option key={one} value={one}>
                {t(`dialect.${one}`)}
              </option>
            ))}
          </select>
        </label>
        <IconButton icon="stack" label={t("libraries.open")} onClick={() => setOpen("libraries")} />
        <IconButton icon="fit" label={t("subranges.open")} onClick={() => setOpen("subranges")} />
      </div>
      {open === "libraries" && <Libraries project={project} onClose={() => setOpen(null)} />}
      {open === "subranges" && <Subranges project={project} onClose={() => setOpen(null)} />}
      {trouble !== null && (
        <p className="lonely" role="alert">
          {trouble}
        </p>
      )}
    </>
  );
}
