import { expect, type Locator, type Page } from '@playwright/test';

/** The error simulator: the model's errors, to be raised and recovered. */
export class Simulator {
  constructor(private readonly page: Page) {}

  get tree(): Locator {
    return this.page.getByRole('treegrid', { name: /^Errors of / });
  }

  error(name: string): Locator {
    return this.tree.getByRole('row').filter({ has: this.page.getByRole('checkbox', { name, exact: true }) });
  }

  get details(): Locator {
    return this.page.getByRole('region', { name: 'Error details' });
  }

  /** A word of the error memory, as it stands below the tree. */
  word(address: string): Locator {
    return this.page.getByTestId(`word:${address}`);
  }

  /** What the last Generate or Recover did, in names. */
  get outcome(): Locator {
    return this.page.locator('[data-pane=errors]').getByRole('status');
  }

  async select(name: string): Promise<void> {
    await this.error(name).click();
    await expect(this.details).toContainText(name);
    await expect(this.error(name)).toBeInViewport();
  }

  async choose(detail: string, option: string | RegExp): Promise<void> {
    const box = this.details.getByRole('combobox', { name: detail });
    const label = await box.getByRole('option', { name: option }).textContent();
    await box.selectOption({ label: label ?? '' });
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
}
