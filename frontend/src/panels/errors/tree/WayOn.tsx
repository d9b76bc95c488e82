import { isPlain } from "../../../logic/errors/shapes";
import { useCatalogue } from "../../../store/errors/catalogue";
import {
  changeDetails,
  mendCondition,
  type Outcome,
  raiseAnyway,
  skipPresent,
  useSimulator,
} from "../../../store/errors/simulator";
import { t } from "../../../text";

/** What to do after a refusal: skip the errors that are present, change their details, or take a name that the PLC knows. */
export function WayOn({ outcome, onDone }: { outcome: Outcome; onDone?: () => void }) {
  const { errors } = useCatalogue();
  const conditional = useSimulator(({ shape }) => shape.when === "condition" || shape.how === "unacknowledged");
  // The others would come now: a fault that begins later or comes and goes is armed, and nothing of it is skipped.
  const plain = useSimulator(({ shape }) => isPlain(shape));
  return (
    <>
      {plain && outcome.present.length > 0 && outcome.present.length < outcome.ids.length && (
        <>
          <button
            type="button"
            className="link"
            title={t("errors.skip.hint")}
            onClick={() => void skipPresent(errors, outcome).then((done) => done && onDone?.())}
          >
            {t("errors.skip")}
          </button>{" "}
        </>
      )}
      {outcome.present.length > 0 && (
        <button
          type="button"
          className="link"
          title={t("errors.again.hint")}
          onClick={() => void changeDetails(errors, outcome).then((done) => done && onDone?.())}
        >
          {t("errors.again")}
        </button>
      )}
      {outcome.absent.length > 0 && (
        <button
          type="button"
          className="link"
          title={t("errors.anyway.hint")}
          onClick={() => void raiseAnyway(outcome.absent).then((done) => done && onDone?.())}
        >
          {t("errors.anyway")}
        </button>
      )}
      {conditional &&
        outcome.near.map((name) => (
          <button key={name} type="button" className="link mono" onClick={() => mendCondition(outcome, name)}>
            {name}
          </button>
        ))}
    </>
  );
}
