import { ComboBox } from "./ComboBox";
import { type Offer, useOffers } from "./useOffers";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** The paths of the program that begin with the text. */
  complete: (text: string) => Promise<readonly Offer[]>;
  placeholder?: string;
  bad?: boolean;
  disabled?: boolean;
  id?: string;
  /** Id of the text that says what is wrong. */
  about?: string;
}

const MOST = 8;

/** A form field for a path, with completion below it. */
export function PathField({ onChange, complete, ...field }: Props) {
  const offering = useOffers(complete, MOST);
  return (
    <ComboBox
      {...field}
      offering={offering}
      className={`inp sm mono grow${field.bad ? " bad" : ""}`}
      onType={(text) => {
        onChange(text);
        offering.ask(text);
      }}
      onTake={({ path }) => {
        onChange(path);
        offering.close();
      }}
    />
  );
}
