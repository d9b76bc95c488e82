import { useCatalogue } from "../../../store/errors/catalogue";
import { changeDetails, mendCondition, type Outcome, useSimulator } from "../../../store/errors/simulator";
import { t } from "../../../text";

/** What to do after a refusal: change the details of present errors, or take a name that the PLC knows. */
export function WayOn({ outcome, onDone }: { outcome: Outcome; onDone?: () => void }) {
  const { errors } = useCatalogue();
  const conditional = useSimulator(({ shape }) => shape.when === "condition" || shape.how === "unacknowledged");
  return (
    <>
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
      {conditional &&
        outcome.near.map((name) => (
          <button key={name} type="button" className="link mono" onClick={() => mendCondition(outcome, name)}>
            {name}
          </button>
        ))}
    </>
  );
}
