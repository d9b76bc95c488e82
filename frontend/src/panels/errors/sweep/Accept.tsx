import { stateWord } from "../../../logic/errors/sweep";
import { acceptFinding } from "../../../store/errors/sweeps";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import type { SweepCell } from "../../../wire/types";

interface Props {
  sweep: number;
  cell: SweepCell;
  name: string;
  onClose: () => void;
}

/** Asks why a finding is acceptable. */
export function Accept({ sweep, cell, name, onClose }: Props) {
  return (
    <AskName
      title={t("sweep.accept.title", { name, state: stateWord(cell.state) })}
      about={t("sweep.accept.about")}
      label={t("sweep.accept.reason")}
      action={t("sweep.accept.do")}
      missing={t("sweep.accept.missing")}
      onName={(reason) => acceptFinding(sweep, cell, reason)}
      onClose={onClose}
    />
  );
}
