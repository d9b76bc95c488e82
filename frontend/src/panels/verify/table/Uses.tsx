import { useEffect, useRef, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useWidths } from "../../../store/page/columns";
import { openFile } from "../../../store/page/navigate";
import { usesOf } from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { useColumns } from "../../../ui/useColumns";
import type { VerifyRow, VerifyUse } from "../../../wire/types";

const SHOWN = 500;

/** The record of used variables of a row: every read and write, in the order of use. */
export function Uses({ row }: { row: VerifyRow }) {
  const [uses, setUses] = useState<readonly VerifyUse[] | null>(null);
  const table = useRef<HTMLTableElement>(null);
  const [refused, setRefused] = useState<string | null>(null);
  useEffect(() => {
    let current = true;
    setUses(null);
    setRefused(null);
    usesOf(row).then(
      (found) => current && setUses(found),
      (error: unknown) => current && setRefused(messageOf(error)),
    );
    return () => {
      current = false;
    };
  }, [row]);
  const { style, th } = useColumns(useWidths("uses"));
  // The list is below the earlier content, perhaps not visible.
  useEffect(() => {
    if (uses) table.current?.scrollIntoView({ block: "nearest" });
  }, [uses]);
  if (refused)
    return (
      <p className="bad" role="alert">
        <Icon name="error" small /> {refused}
      </p>
    );
  if (!uses) return <p className="faint">{t("verify.uses.asked")}</p>;
  if (uses.length === 0) return <p className="faint">{t("verify.uses.none")}</p>;
  return (
    <table ref={table} className="vfuses" style={style}>
      <caption className="sr">{t("verify.uses")}</caption>
      <thead>
        <tr>
          {th("line", t("verify.uses.line"))}
          {th("name", t("verify.uses.name"))}
          {th("how", t("verify.uses.how"))}
          {th("control", "A")}
          <th scope="col">A′</th>
        </tr>
      </thead>
      <tbody>
        {uses.slice(0, SHOWN).map((use, at) => (
          // biome-ignore lint/suspicious/noArrayIndexKey: only the order distinguishes them
          <tr key={at} className={use.control === use.monitor ? "" : "dr"}>
            <td>
              <button type="button" className="link mono" onClick={() => openFile(use.file, use.line)}>
                {use.line}
              </button>
            </td>
            <td className="mono" title={use.instance}>
              {use.name}
            </td>
            <td>{t(use.written ? "verify.uses.written" : "verify.uses.read")}</td>
            <td className="mono num">{use.control ?? "–"}</td>
            <td className="mono num">
              {use.control !== use.monitor && <Icon name="differs" small className="diffc" />}
              {use.monitor ?? "–"}
            </td>
          </tr>
        ))}
        {uses.length > SHOWN && (
          <tr>
            <td colSpan={5} className="faint">
              {t("verify.uses.more", { count: uses.length - SHOWN })}
            </td>
          </tr>
        )}
      </tbody>
    </table>
  );
}
