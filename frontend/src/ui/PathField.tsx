import { ComboBox } from "./ComboBox";
import { type Offer, useOffers } from "./useOffers";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** What the program has that begins like this. */
  complete: (text: string) => Promise<readonly Offer[]>;
  placeholder?: string;
  bad?: boolean;
  disabled?: boolean;
  id?: string;
  /** Id of the text that says why it is bad. */
  about?: string;
}

const MOST = 8;

/** A path that is filled in, with what the running program has to offer below it. */
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
