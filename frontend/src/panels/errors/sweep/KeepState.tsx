import { grouped } from "../../../logic/format/numbers";
import { closeQuestion, keepStateAs } from "../../../store/errors/sweeps";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";

/** Asks for the name of a kept state. */
export function KeepState({ scan }: { scan: number | null }) {
  const name = useBench((bench) => bench.instance?.name ?? "");
  return (
    <AskName
      title={
        scan === null ? t("states.keep.title", { name }) : t("states.keep.title.scan", { name, scan: grouped(scan) })
      }
      about={t("states.keep.about")}
      label={t("states.keep.name")}
      action={t("states.keep.do")}
      onName={async (wanted) => void (await keepStateAs(wanted, scan))}
      onClose={closeQuestion}
    />
  );
}
