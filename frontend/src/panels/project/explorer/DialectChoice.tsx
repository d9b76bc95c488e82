import { useEffect } from "react";
import {
  changeDialect,
  DIALECTS,
  type Dialect,
  loadDialect,
  useDialect,
  useDialectVersion,
} from "../../../store/project/dialect";
import { t } from "../../../text";

/** The dialect that the programs of the project are written in: shown, and changed. */
export function DialectChoice({ project }: { project: number }) {
  const { dialect, trouble } = useDialect();
  const version = useDialectVersion();
  // biome-ignore lint/correctness/useExhaustiveDependencies: a new version of the file may name a different dialect
  useEffect(() => void loadDialect(project), [project, version]);
  if (dialect === null) return null;
  return (
    <>
      <label className="sub dialect" title={t("dialect.about")}>
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
      {trouble !== null && (
        <p className="lonely" role="alert">
          {trouble}
        </p>
      )}
    </>
  );
}
