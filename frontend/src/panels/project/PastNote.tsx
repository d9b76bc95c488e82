import { grouped } from "../../logic/format/numbers";
import { useRanApart } from "../../store/project/shownProgram";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";

/** Says in the past that a different program version ran than the one whose files are shown. */
export function PastNote({ of }: { of: "files" | "problems" | "cross" }) {
  const ran = useRanApart();
  if (ran === null) return null;
  return (
    <p className="trouble st past">
      <Icon name="past" small />
      <span>{t(`past.${of}`, { version: ran.version, scan: grouped(ran.scan) })}</span>
    </p>
  );
}
