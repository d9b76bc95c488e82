import { useBench } from "../../../store/plc/bench";
import { useDisturb } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { DisturbForm } from "./DisturbForm";
import "./disturb.css";
import { DisturbList } from "./DisturbList";
import { NoneYet } from "./NoneYet";

/** Faults that a robust program must tolerate: bits that flip, inputs that are late or stuck, results that are wrong. */
export function DisturbPanel() {
  const instance = useBench((bench) => bench.instance);
  const none = useDisturb(({ disturbances }) => disturbances.length === 0);
  return (
    <div className="pane flexcol disturb" data-pane="disturb" data-live>
      {instance ? (
        <>
          {none ? <NoneYet /> : <DisturbList />}
          <DisturbForm />
        </>
      ) : (
        <p className="lonely faint">{t("disturb.noinstance")}</p>
      )}
    </div>
  );
}
