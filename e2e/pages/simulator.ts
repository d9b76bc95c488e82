import { expect, type Locator, type Page } from '@playwright/test';

/** The error simulator, which raises and recovers the errors of the model. */
export class Simulator {
  constructor(private readonly page: Page) {}

  private get pane(): Locator {
    return this.page.locator('[data-pane=errors]');
  }

  get tree(): Locator {
    return this.page.getByRole('treegrid', { name: /^Errors of / });
  }

  /** The row of an error. */
  error(name: string): Locator {
    return this.tree.getByRole('row').filter({ has: this.page.getByRole('checkbox', { name, exact: true }) });
  }

  /** The row of a group, found in the same way. */
  group(name: string): Locator {
    return this.error(name);
  }

  /** The box of an error or a group. */
  box(name: string): Locator {
    return this.tree.getByRole('checkbox', { name, exact: true });
  }

  get details(): Locator {
    return this.page.getByRole('region', { name: 'Error details' });
  }

  get preview(): Locator {
    return this.details.getByRole('region', { name: 'What will be written' });
  }

  get reaction(): Locator {
    return this.details.getByRole('region', { name: 'Reaction of the program' });
  }

  /** Scheduled and recurring faults. */
  get armed(): Locator {
    return this.pane.getByRole('region', { name: 'Armed faults' });
  }

  /** Details of several errors. */
  get dialog(): Locator {
    return this.page.getByRole('dialog', { name: 'Error details' });
  }

  /** The page of an error in the dialog. */
  dialogPage(name: string): Locator {
    return this.dialog.getByRole('group', { name: `Details of ${name}` });
  }

  /** The error in the list of the dialog. */
  step(name: string): Locator {
    return this.dialog.getByRole('list', { name: 'Errors that need details' }).getByRole('button', { name });
  }

  get generateButton(): Locator {
    return this.pane.getByRole('button', { name: /^(Generate|Arm)( \d+…?)?$/ });
  }

  /** Why the last command was refused. */
  get refusal(): Locator {
    return this.pane.getByRole('alert');
  }

  /** A word of the error memory, as shown below the tree. */
  word(address: string): Locator {
    return this.page.getByTestId(`word:${address}`);
  }

  /** The result of the last Generate or Recover, with the names of the errors. */
  get outcome(): Locator {
    return this.pane.getByRole('status');
  }

  async select(name: string): Promise<void> {
    const row = this.error(name);
    // What is told of the errors that were raised makes the details longer, and moves the rows: also under the mouse.
    await expect(async () => {
      await row.click();
      await expect(row).toHaveAttribute('aria-selected', 'true', { timeout: 2_000 });
    }).toPass();
    await expect(this.details).toContainText(name);
    await expect(row).toBeInViewport();
  }

  async choose(detail: string, option: string | RegExp): Promise<void> {
    const box = this.details.getByRole('combobox', { name: detail });
    const label = await box.getByRole('option', { name: option }).textContent();
    await box.selectOption({ label: label ?? '' });
  }

  /** When the fault begins, how it continues. */
  async shape(what: 'When' | 'How', option: string): Promise<void> {
    await this.details.getByRole('combobox', { name: what, exact: true }).selectOption({ label: option });
  }

  async generate(name: string): Promise<void> {
    await this.select(name);
    await this.page.getByRole('button', { name: 'Generate', exact: true }).click();
    await expect(this.error(name)).toContainText('Generated');
    await expect(this.error(name)).toBeInViewport();
  }

  async recover(name: string): Promise<void> {
    await this.select(name);
    await this.page.getByRole('button', { name: 'Recover', exact: true }).click();
    await expect(this.error(name)).toContainText('Cleared');
  }

  async filterBy(option: string): Promise<void> {
    await this.pane.getByRole('button', { name: /^Filter: / }).click();
    await this.page.getByRole('menuitemradio', { name: option, exact: true }).click();
  }
}
